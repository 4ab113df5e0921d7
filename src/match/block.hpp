// The file behind SearchBlock: groups of shapes, then the table of groups.
//
// A group of r shapes is columns that a search reads of every shape, then records and names that
// it reads of few:
//
//   checksums  u64 × r      of what is read of a record and of the name
//   name ends  u32 × r      in the names of the group
//   sums       u16 × r × kRuns, run by run: of short runs of the tables
//   solidity   u8 × r       the first value of the tables
//   records    kRecordBytes × r, from the next multiple of 64 bytes: encode() and zeros
//   names      one after another, and zeros up to a multiple of 64 bytes
//
// The columns have a checksum of their own, so that nothing is used unchecked. Numbers are in the
// machine's own order: the file is a copy that is made anew where it does not fit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <morsel/signature.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "signature/tables.hpp"

namespace morsel::block {

inline constexpr std::size_t kGroupRows = 4096;  // the last group may have fewer
inline constexpr std::size_t kRecordBytes = kMostSignatureBytes;

/// Into how many runs each block of the tables is cut; more where neighbours differ more.
inline constexpr std::array<std::size_t, kTableBlocks.size()> kRunsOfBlock{9, 6, 12, 4, 6};
inline constexpr std::size_t kRuns = [] {
  std::size_t count = 0;
  for (const std::size_t runs : kRunsOfBlock) count += runs;
  return count;
}();
using RunSums = std::array<std::uint16_t, kRuns>;

/// |Σa - Σb| of a run is at most the run's L1 distance: sums give a lower bound of a distance from
/// an eighth of its bytes. `tables` holds kTableSize values.
[[nodiscard]] RunSums run_sums(const std::uint8_t* tables);

/// Where the columns, records and names of a group begin, from its own beginning.
struct Layout {
  explicit constexpr Layout(std::size_t rows)
      : name_ends(8 * rows),
        sums(12 * rows),
        solidity((12 + 2 * kRuns) * rows),
        columns_end((13 + 2 * kRuns) * rows),
        records((columns_end + 63) / 64 * 64),
        names(records + kRecordBytes * rows) {}
  std::size_t name_ends, sums, solidity, columns_end, records, names;
};

/// A group's entry in the table at the end of the file.
struct Group {
  std::uint64_t offset = 0;
  std::uint64_t rows = 0;
  std::uint64_t name_bytes = 0;
  std::uint64_t checksum = 0;  ///< of the columns
};

/// The last bytes of the file, after the table of groups.
struct Tail {
  std::uint64_t magic = 0;
  std::uint64_t shapes = 0;
  std::uint64_t groups = 0;
  std::uint64_t checksum = 0;  ///< of the table, with the numbers above as seed
};

/// "MRSLBLK2" in the machine's own order.
inline constexpr std::uint64_t kMagic = 0x4d52534c424c4b32;

/// Of the head and tables of a record, and the name.
[[nodiscard]] std::uint64_t row_checksum(const char* record, std::string_view name);
[[nodiscard]] std::uint64_t table_checksum(std::span<const Group> groups, std::uint64_t shapes);
[[nodiscard]] std::uint64_t columns_checksum(const char* columns, std::size_t bytes);

/// A shape as it stands in a mapped file; valid as long as that.
struct Row {
  const char* record = nullptr;
  std::string_view name;

  [[nodiscard]] const std::uint8_t* tables() const;
  [[nodiscard]] bool is_empty() const;  ///< a signature without a size
};

/// A mapped file. Everything it returns has its checksum; Error(kInput) is thrown otherwise.
class Mapping {
 public:
  /// Reads the table of groups alone.
  explicit Mapping(std::filesystem::path path);
  ~Mapping();
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::span<const Group> groups() const { return groups_; }

  /// Beginning of a group whose columns have their checksum.
  [[nodiscard]] const char* columns(const Group& group) const;
  [[nodiscard]] Row row(std::size_t index) const;
  [[nodiscard]] Signature signature(const Row& row) const;

 private:
  void read_table();
  [[noreturn]] void fail(const std::string& reason) const;

  std::filesystem::path path_;
  const char* data_ = nullptr;
  std::size_t bytes_ = 0;
  std::size_t count_ = 0;
  std::vector<Group> groups_;
};

}  // namespace morsel::block
