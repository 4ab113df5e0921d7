// The tables of a signature: joint statistics that need no alignment. docs/signature.md has the
// formulas and what each table is worth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <morsel/delaunay.hpp>
#include <morsel/segment.hpp>
#include <vector>

namespace morsel {

/// What a table is read from: those of the inside count as far as there is one.
enum class TableSource : std::uint8_t { kSurface, kInside };

/// A run of values in the tables that are compared as one.
struct TableBlock {
  const char* name = "";
  std::size_t offset = 0;
  std::size_t size = 0;
  TableSource source = TableSource::kSurface;
  double unit = 1.0;         ///< mean L1 distance of two shapes of the development half, in bytes
  double articulated = 1.0;  ///< weight among shapes that bend; 1 for each among rigid ones
};

/// The first value is the solidity; then the blocks.
inline constexpr std::array<TableBlock, 5> kTableBlocks{{
    {"shells", 1, 105, TableSource::kSurface, 916.0, 0.5},
    {"facing", 106, 180, TableSource::kSurface, 2810.0, 1.0},
    {"pairs", 286, 144, TableSource::kSurface, 937.0, 1.0},
    {"thickness", 430, 120, TableSource::kInside, 2234.0, 1.0},
    {"centricity", 550, 72, TableSource::kInside, 1156.0, 2.0},
}};
inline constexpr std::size_t kTableSize = kTableBlocks.back().offset + kTableBlocks.back().size;

/// (kTableSize) values. The cells' neighbours are not read. Cost: O(c).
[[nodiscard]] std::vector<std::uint8_t> make_tables(const DelaunayComplex& complex,
                                                    const Basins& basins, int threads);

}  // namespace morsel
