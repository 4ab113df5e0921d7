// A file of signatures mapped into memory: head, ends of the names, sketches, records, names.
//
// A sketch holds the sums of short runs of the tables. |Σa - Σb| of a run is at most the run's L1
// distance, so sketches give a lower bound of a distance from a tenth of its bytes.

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <limits>
#include <morsel/error.hpp>
#include <morsel/search.hpp>
#include <numeric>

#include "base/atomic_file.hpp"
#include "io/bytes.hpp"
#include "match/score.hpp"
#include "signature/layout.hpp"

namespace morsel {
namespace {

constexpr std::string_view kMagic = "MRSLBLK1";
constexpr std::size_t kRun = 24;  // about as many values are added up

constexpr std::size_t runs_of(const TableBlock& block) { return (block.size + kRun - 1) / kRun; }
constexpr std::size_t count_runs() {
  std::size_t count = 0;
  for (const TableBlock& block : kTableBlocks) count += runs_of(block);
  return count;
}
constexpr std::size_t kRuns = count_runs();
using Sketch = std::array<std::uint16_t, kRuns + 1>;  // the last is the solidity

constexpr std::size_t kHeadBytes = 16;  // magic, number of shapes
constexpr std::size_t kRecordBytes = kMostSignatureBytes;

Sketch sketch_of(const std::uint8_t* tables) {
  Sketch sketch{};
  std::size_t run = 0;
  for (const TableBlock& block : kTableBlocks) {
    for (std::size_t i = 0; i < runs_of(block); ++i, ++run) {
      const std::size_t begin = block.size * i / runs_of(block);
      const std::size_t end = block.size * (i + 1) / runs_of(block);
      for (std::size_t k = begin; k < end; ++k) {
        sketch[run] = static_cast<std::uint16_t>(sketch[run] + tables[block.offset + k]);
      }
    }
  }
  sketch[kRuns] = tables[0];
  return sketch;
}

// Never above the distance of the tables.
double lower_bound(const Sketch& a, const Sketch& b) {
  std::array<std::uint16_t, kRuns> apart{};
  for (std::size_t i = 0; i < kRuns; ++i) {
    apart[i] = static_cast<std::uint16_t>(std::max(a[i], b[i]) - std::min(a[i], b[i]));
  }
  BlockSums sums{};
  std::size_t run = 0;
  for (std::size_t k = 0; k < kTableBlocks.size(); ++k) {
    for (std::size_t i = 0; i < runs_of(kTableBlocks[k]); ++i) sums[k] += apart[run++];
  }
  return table_distance(sums, static_cast<std::uint8_t>(a[kRuns]),
                        static_cast<std::uint8_t>(b[kRuns]));
}

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
    const Sketch sketch = sketch_of(tables_of(signature).data());
    std::string bytes;
    for (const std::uint16_t value : sketch) io::append_bytes(bytes, value);
    file.stream() << bytes;
  }
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
  [[nodiscard]] Sketch sketch(std::size_t i) const {
    const char* from = data_ + kHeadBytes + 8 * count_ + sizeof(Sketch) * i;
    Sketch sketch;
    std::memcpy(sketch.data(), from, sizeof(Sketch));
    if constexpr (std::endian::native == std::endian::big) {
      for (std::size_t k = 0; k < sketch.size(); ++k) {
        sketch[k] = io::load_as<std::uint16_t>(from + 2 * k);
      }
    }
    return sketch;
  }
  [[nodiscard]] const std::uint8_t* tables(std::size_t i) const {
    return reinterpret_cast<const std::uint8_t*>(record(i) + kTablesAt);
  }
  [[nodiscard]] bool is_empty(std::size_t i) const {
    return !(io::load_as<double>(record(i) + kSizeAt) > 0.0);
  }
  [[nodiscard]] Signature signature(std::size_t i) const {
    const char* record = this->record(i);
    const auto length = std::min<std::size_t>(io::load_as<std::uint16_t>(record + 6), kRecordBytes);
    return decode(std::as_bytes(std::span(record, length)), path_.string());
  }

 private:
  [[nodiscard]] const char* record(std::size_t i) const {
    return data_ + kHeadBytes + (8 + sizeof(Sketch)) * count_ + kRecordBytes * i;
  }
  [[nodiscard]] std::size_t names_at() const {
    return kHeadBytes + (8 + sizeof(Sketch) + kRecordBytes) * count_;
  }
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

namespace {

struct Candidate {
  double bound = 0.0;  // the distance is at least this
  std::uint32_t index = 0;
};

// The best hits so far; `worst` at the end.
class BestHits {
 public:
  BestHits(const SearchBlock& block, std::size_t k) : block_(block), k_(k) {}

  // The score that a shape must reach to matter.
  [[nodiscard]] double threshold() const {
    return hits_.size() < k_ ? -std::numeric_limits<double>::infinity() : hits_.front().score;
  }
  void offer(const Hit& hit) {
    const auto better = [this](const Hit& a, const Hit& b) {
      return a.score != b.score ? a.score > b.score : block_.name(a.index) < block_.name(b.index);
    };
    hits_.push_back(hit);
    std::ranges::push_heap(hits_, better);
    if (hits_.size() <= k_) return;
    std::ranges::pop_heap(hits_, better);
    hits_.pop_back();
  }
  [[nodiscard]] std::vector<Hit> take() {
    std::ranges::sort(hits_, [this](const Hit& a, const Hit& b) {
      return a.score != b.score ? a.score > b.score : block_.name(a.index) < block_.name(b.index);
    });
    return std::move(hits_);
  }

 private:
  const SearchBlock& block_;
  std::size_t k_;
  std::vector<Hit> hits_;
};

// Calls visit(index) in ascending order of the bounds until `enough(bound)`. The order is made in
// steps, so that the many that are never reached are not sorted.
template <typename Enough, typename Visit>
void visit_ascending(std::vector<Candidate>& candidates, const Enough& enough, const Visit& visit) {
  const auto before = [](const Candidate& a, const Candidate& b) {
    return a.bound != b.bound ? a.bound < b.bound : a.index < b.index;
  };
  std::size_t step = 256;
  for (auto begin = candidates.begin(); begin != candidates.end(); step *= 4) {
    const auto left = static_cast<std::size_t>(candidates.end() - begin);
    const auto end = begin + static_cast<std::ptrdiff_t>(std::min(step, left));
    if (end != candidates.end()) std::nth_element(begin, end, candidates.end(), before);
    std::sort(begin, end, before);
    for (; begin != end; ++begin) {
      if (enough(begin->bound)) return;
      visit(*begin);
    }
  }
}

}  // namespace

std::vector<Hit> SearchBlock::search(const Signature& query, std::size_t k,
                                     const MatchOptions& options) const {
  options.check();
  BestHits best(*this, k);
  if (k == 0) return {};
  if (options.method == Method::kPaper) {
    for (std::size_t i = 0; i < size(); ++i) {
      best.offer({i, match_score(query, signature(i), options)});
    }
    return best.take();
  }
  const auto tables = tables_of(query);
  const Sketch sketch = sketch_of(tables.data());
  std::vector<Candidate> candidates(size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i] = {lower_bound(sketch, mapping_->sketch(i)), static_cast<std::uint32_t>(i)};
  }
  const auto enough = [&](double bound) { return score_of_distance(bound) < best.threshold(); };
  visit_ascending(candidates, enough, [&](const Candidate& candidate) {
    const std::size_t i = candidate.index;
    const std::uint8_t* other = mapping_->tables(i);
    const double distance = table_distance(block_sums(tables.data(), other), tables[0], other[0]);
    double score = score_of_distance(distance);
    if (score < best.threshold()) return;
    if ((query.size > 0.0) == mapping_->is_empty(i)) {
      score = 0.0;
    } else if (!options.mirror) {
      score *= same_handedness(query, signature(i));
    }
    best.offer({i, score});
  });
  return best.take();
}

}  // namespace morsel
