// The tables of a signature: joint statistics of the inside that need no alignment.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <morsel/delaunay.hpp>
#include <morsel/interior.hpp>
#include <morsel/segment.hpp>
#include <span>
#include <vector>

namespace morsel {

/// Centroid and RMS radius of what the tables are about.
struct Frame {
  Vec3 centroid;
  double size = 0.0;
};

/// A run of values in the tables that are compared with one weight.
struct TableBlock {
  std::size_t offset = 0;
  std::size_t size = 0;
  double weight = 0.0;  ///< of one byte of difference in the distance of two signatures
};

inline constexpr std::array<TableBlock, 1> kTableBlocks{{{0, 168, 1.0 / 1500.0}}};
inline constexpr std::size_t kTableSize = kTableBlocks.back().offset + kTableBlocks.back().size;

/// (kTableSize) values. Cost: O(c).
[[nodiscard]] std::vector<std::uint8_t> make_tables(const DelaunayComplex& complex,
                                                    const Interior& interior, const Basins& basins,
                                                    const Frame& frame);

}  // namespace morsel
