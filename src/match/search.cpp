// A file of signatures mapped into memory: head, one record of fixed size a shape, names.

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <morsel/error.hpp>
#include <morsel/search.hpp>

#include "base/atomic_file.hpp"
#include "io/bytes.hpp"

namespace morsel {
namespace {

constexpr std::string_view kMagic = "MRSLBLK1";
constexpr std::size_t kHeadBytes = 16;  // magic, number of shapes
constexpr std::size_t kRecordBytes = kMostSignatureBytes;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ErrorCode::kInput, path.string() + ": " + reason);
}

}  // namespace

void write_search_block(const std::filesystem::path& path, std::span<const std::string> names,
                        std::span<const Signature> signatures) {
  if (names.size() != signatures.size()) {
    throw Error(ErrorCode::kUsage, std::to_string(names.size()) + " names for " +
                                       std::to_string(signatures.size()) +
                                       " signatures; one each is expected");
  }
  AtomicFile file(path);
  std::string head(kMagic);
  io::append_bytes(head, static_cast<std::uint64_t>(names.size()));
  std::uint64_t end = 0;
  std::string ends;
  for (const std::string& name : names) io::append_bytes(ends, end += name.size());
  file.stream() << head << ends;
  for (const Signature& signature : signatures) {
    std::vector<std::byte> record = encode(signature);
    record.resize(kRecordBytes);
    file.stream().write(reinterpret_cast<const char*>(record.data()), kRecordBytes);
  }
  for (const std::string& name : names) file.stream() << name;
  file.commit();
}

class SearchBlock::Mapping {
 public:
  explicit Mapping(const std::filesystem::path& path) : path_(path) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) fail(path, std::string("cannot read: ") + std::strerror(errno));
    struct stat status {};
    ::fstat(fd, &status);
    bytes_ = static_cast<std::size_t>(status.st_size);
    void* at = bytes_ > 0 ? ::mmap(nullptr, bytes_, PROT_READ, MAP_SHARED, fd, 0) : MAP_FAILED;
    ::close(fd);
    if (at == MAP_FAILED) fail(path, "is no search block: it cannot be mapped");
    data_ = static_cast<const char*>(at);
  }
  ~Mapping() { ::munmap(const_cast<char*>(data_), bytes_); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  void check() {
    if (bytes_ < kHeadBytes || std::string_view(data_, kMagic.size()) != kMagic) {
      fail(path_, "is no search block: it does not begin with \"MRSLBLK1\"");
    }
    count_ = io::load_as<std::uint64_t>(data_ + kMagic.size());
    if (count_ > bytes_ / kRecordBytes) fail(path_, "is cut short");
    if (bytes_ < names_at() || bytes_ - names_at() != (count_ > 0 ? name_end(count_ - 1) : 0)) {
      fail(path_, "is cut short or damaged");
    }
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::string_view name(std::size_t i) const {
    const std::size_t begin = i > 0 ? name_end(i - 1) : 0;
    const std::size_t end = name_end(i);
    if (begin > end || end > bytes_ - names_at()) fail(path_, "has damaged names");
    return {data_ + names_at() + begin, end - begin};
  }
  [[nodiscard]] Signature signature(std::size_t i) const {
    const char* record = data_ + kHeadBytes + 8 * count_ + kRecordBytes * i;
    const auto length = std::min<std::size_t>(io::load_as<std::uint16_t>(record + 6), kRecordBytes);
    return decode(std::as_bytes(std::span(record, length)), path_.string());
  }

 private:
  [[nodiscard]] std::size_t names_at() const { return kHeadBytes + (8 + kRecordBytes) * count_; }
  [[nodiscard]] std::size_t name_end(std::size_t i) const {
    return io::load_as<std::uint64_t>(data_ + kHeadBytes + 8 * i);
  }

  std::filesystem::path path_;
  const char* data_ = nullptr;
  std::size_t bytes_ = 0;
  std::size_t count_ = 0;
};

SearchBlock::SearchBlock(std::unique_ptr<Mapping> mapping) : mapping_(std::move(mapping)) {}
SearchBlock::SearchBlock(SearchBlock&&) noexcept = default;
SearchBlock& SearchBlock::operator=(SearchBlock&&) noexcept = default;
SearchBlock::~SearchBlock() = default;

SearchBlock SearchBlock::open(const std::filesystem::path& path) {
  auto mapping = std::make_unique<Mapping>(path);
  mapping->check();
  return SearchBlock(std::move(mapping));
}

std::size_t SearchBlock::size() const { return mapping_->count(); }
std::string_view SearchBlock::name(std::size_t index) const { return mapping_->name(index); }
Signature SearchBlock::signature(std::size_t index) const { return mapping_->signature(index); }

std::vector<Hit> SearchBlock::search(const Signature& query, std::size_t k,
                                     const MatchOptions& options) const {
  std::vector<Hit> hits;
  for (std::size_t i = 0; i < size(); ++i) {
    hits.push_back({i, match_score(query, signature(i), options)});
  }
  std::ranges::sort(hits, [&](const Hit& a, const Hit& b) {
    return a.score != b.score ? a.score > b.score : name(a.index) < name(b.index);
  });
  if (hits.size() > k) hits.resize(k);
  return hits;
}

}  // namespace morsel
