#include "match/block.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <morsel/error.hpp>
#include <morsel/search.hpp>
#include <string>
#include <utility>

#include "base/atomic_file.hpp"
#include "io/bytes.hpp"
#include "match/score.hpp"
#include "signature/layout.hpp"

namespace morsel::block {
namespace {

// Up to here a record holds what the default score reads.
constexpr std::size_t kReadBytes = kTablesAt + kTableSize;

template <class T>
T load(const char* from) {
  return io::load_as<T>(from, std::endian::native);
}

template <class T>
void append(std::string& to, const T* values, std::size_t count) {
  to.append(reinterpret_cast<const char*>(values), sizeof(T) * count);
}

void pad(std::string& bytes) { bytes.resize((bytes.size() + 63) / 64 * 64); }

}  // namespace

RunSums run_sums(const std::uint8_t* tables) {
  RunSums sums{};
  std::size_t run = 0;
  for (std::size_t k = 0; k < kTableBlocks.size(); ++k) {
    const std::size_t offset = kTableBlocks[k].offset;
    const std::size_t size = kTableBlocks[k].size;
    for (std::size_t i = 0; i < kRunsOfBlock[k]; ++i, ++run) {
      const std::uint8_t* const begin = tables + offset + size * i / kRunsOfBlock[k];
      const std::uint8_t* const end = tables + offset + size * (i + 1) / kRunsOfBlock[k];
      for (const std::uint8_t* value = begin; value != end; ++value) {
        sums[run] = static_cast<std::uint16_t>(sums[run] + *value);
      }
    }
  }
  return sums;
}

std::uint64_t row_checksum(const char* record, std::string_view name) {
  return XXH3_64bits_withSeed(name.data(), name.size(), XXH3_64bits(record, kReadBytes));
}

std::uint64_t table_checksum(std::span<const Group> groups, std::uint64_t shapes) {
  return XXH3_64bits_withSeed(groups.data(), groups.size_bytes(), kMagic ^ shapes);
}

std::uint64_t columns_checksum(const char* columns, std::size_t bytes) {
  return XXH3_64bits(columns, bytes);
}

const std::uint8_t* Row::tables() const {
  return reinterpret_cast<const std::uint8_t*>(record + kTablesAt);
}

bool Row::is_empty() const { return !(io::load_as<double>(record + kSizeAt) > 0.0); }

Mapping::Mapping(std::filesystem::path path) : path_(std::move(path)) {
  const int fd = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) fail(std::string("cannot read: ") + std::strerror(errno));
  struct stat status {};
  ::fstat(fd, &status);
  bytes_ = static_cast<std::size_t>(status.st_size);
  void* at = bytes_ > 0 ? ::mmap(nullptr, bytes_, PROT_READ, MAP_SHARED, fd, 0) : MAP_FAILED;
  ::close(fd);
  if (at == MAP_FAILED) fail("is no search block: it cannot be mapped");
  data_ = static_cast<const char*>(at);
  try {
    read_table();
  } catch (...) {
    ::munmap(at, bytes_);
    throw;
  }
}

Mapping::~Mapping() { ::munmap(const_cast<char*>(data_), bytes_); }

void Mapping::fail(const std::string& reason) const {
  throw Error(ErrorCode::kInput, path_.string() + ": " + reason);
}

void Mapping::read_table() {
  if (bytes_ < sizeof(Tail)) fail("is no search block, or cut short");
  const auto tail = load<Tail>(data_ + bytes_ - sizeof(Tail));
  if (tail.magic != kMagic) fail("is no search block of this version, or cut short");
  const std::size_t most = (bytes_ - sizeof(Tail)) / sizeof(Group);
  if (tail.groups > most) fail("is cut short or damaged");
  const std::size_t table = bytes_ - sizeof(Tail) - tail.groups * sizeof(Group);
  groups_.resize(tail.groups);
  if (!groups_.empty()) std::memcpy(groups_.data(), data_ + table, tail.groups * sizeof(Group));
  if (table_checksum(groups_, tail.shapes) != tail.checksum) fail("is damaged");
  // A checksum may fit by design: the file is looked at, wherever it came from.
  std::size_t offset = 0;
  for (const Group& group : groups_) {
    const bool last = &group == &groups_.back();
    const bool counts =
        group.rows > 0 && (last ? group.rows <= kGroupRows : group.rows == kGroupRows);
    if (!counts || group.offset != offset || group.name_bytes > table) fail("is damaged");
    offset += (Layout(group.rows).names + group.name_bytes + 63) / 64 * 64;
    if (offset > table) fail("is damaged");
    count_ += group.rows;
  }
  if (offset != table || count_ != tail.shapes) fail("is damaged");
}

const char* Mapping::columns(const Group& group) const {
  const char* const begin = data_ + group.offset;
  if (columns_checksum(begin, Layout(group.rows).columns_end) != group.checksum) {
    fail("is damaged: the sums of its tables do not have their checksum");
  }
  return begin;
}

Row Mapping::row(std::size_t index) const {
  const Group& group = groups_[index / kGroupRows];
  const std::size_t i = index % kGroupRows;
  const Layout layout(group.rows);
  const char* const begin = data_ + group.offset;
  const auto name_end = [&](std::size_t k) {
    return load<std::uint32_t>(begin + layout.name_ends + 4 * k);
  };
  const std::size_t from = i > 0 ? name_end(i - 1) : 0;
  const std::size_t to = name_end(i);
  if (from > to || to > group.name_bytes) fail("is damaged: it has no names where they should be");
  const Row row{begin + layout.records + kRecordBytes * i,
                {begin + layout.names + from, to - from}};
  if (row_checksum(row.record, row.name) != load<std::uint64_t>(begin + 8 * i)) {
    fail("is damaged: shape " + std::to_string(index) + " does not have its checksum");
  }
  return row;
}

Signature Mapping::signature(const Row& row) const {
  const auto length =
      std::min<std::size_t>(io::load_as<std::uint16_t>(row.record + kLengthAt), kRecordBytes);
  return decode(std::as_bytes(std::span(row.record, length)), path_.string());
}

}  // namespace morsel::block

namespace morsel {

// Fills one group after another.
struct SearchBlockWriter::State {
  explicit State(const std::filesystem::path& path) : file(path) {}

  void add(std::string_view name, const Signature& signature);
  void end_group();
  void commit();

  AtomicFile file;
  std::vector<block::Group> groups;
  std::uint64_t offset = 0;
  std::uint64_t shapes = 0;
  // Of the present group.
  std::vector<std::uint64_t> checksums;
  std::vector<std::uint32_t> name_ends;
  std::vector<block::RunSums> sums;
  std::string solidity;
  std::string records;
  std::string names;
};

void SearchBlockWriter::State::add(std::string_view name, const Signature& signature) {
  const std::vector<std::byte> bytes = encode(signature);
  const std::size_t at = records.size();
  records.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  records.resize(at + block::kRecordBytes);
  const block::Row row{records.data() + at, name};
  checksums.push_back(block::row_checksum(row.record, row.name));
  names += name;
  name_ends.push_back(static_cast<std::uint32_t>(names.size()));
  sums.push_back(block::run_sums(row.tables()));
  solidity += static_cast<char>(row.tables()[0]);
  if (checksums.size() == block::kGroupRows) end_group();
}

void SearchBlockWriter::State::end_group() {
  const std::size_t rows = checksums.size();
  if (rows == 0) return;
  std::string bytes;
  bytes.reserve(block::Layout(rows).names + names.size() + 64);
  block::append(bytes, checksums.data(), rows);
  block::append(bytes, name_ends.data(), rows);
  for (std::size_t run = 0; run < block::kRuns; ++run) {
    for (const block::RunSums& of_row : sums) block::append(bytes, &of_row[run], 1);
  }
  bytes += solidity;
  groups.push_back(
      {offset, rows, names.size(), block::columns_checksum(bytes.data(), bytes.size())});
  block::pad(bytes);
  bytes += records;
  bytes += names;
  block::pad(bytes);
  file.stream() << bytes;
  offset += bytes.size();
  shapes += rows;
  checksums.clear();
  name_ends.clear();
  sums.clear();
  for (std::string* text : {&solidity, &records, &names}) text->clear();
}

void SearchBlockWriter::State::commit() {
  end_group();
  const block::Tail tail{block::kMagic, shapes, groups.size(),
                         block::table_checksum(groups, shapes)};
  std::string bytes;
  block::append(bytes, groups.data(), groups.size());
  block::append(bytes, &tail, 1);
  file.stream() << bytes;
  file.commit();
}

SearchBlockWriter::SearchBlockWriter(const std::filesystem::path& path)
    : state_(std::make_unique<State>(path)) {}
SearchBlockWriter::SearchBlockWriter(SearchBlockWriter&&) noexcept = default;
SearchBlockWriter& SearchBlockWriter::operator=(SearchBlockWriter&&) noexcept = default;
SearchBlockWriter::~SearchBlockWriter() = default;

void SearchBlockWriter::add(std::string_view name, const Signature& signature) {
  state_->add(name, signature);
}
void SearchBlockWriter::commit() { state_->commit(); }

void write_search_block(const std::filesystem::path& path, std::span<const std::string> names,
                        std::span<const Signature> signatures) {
  if (names.size() != signatures.size()) {
    throw Error(ErrorCode::kUsage, std::to_string(names.size()) + " names for " +
                                       std::to_string(signatures.size()) +
                                       " signatures; one each is expected");
  }
  SearchBlockWriter writer(path);
  for (std::size_t i = 0; i < names.size(); ++i) writer.add(names[i], signatures[i]);
  writer.commit();
}

}  // namespace morsel
