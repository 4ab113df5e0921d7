// Pieces of the inside, finer than any part: what the merge tree of the default method joins.
#pragma once

#include <cstdint>
#include <functional>
#include <morsel/segment.hpp>
#include <vector>

namespace morsel {

/// The inside cut along the flow and, where a region without necks is long or wide, cut again into
/// regions of about equal extent, so that parts can end where the flow offers no cut.
struct Pieces {
  std::vector<std::uint32_t> piece_of_cell;  ///< (c), kNoBasin where not inner
  std::vector<std::uint32_t> region;         ///< (p) the group of basins that each piece lies in
  std::vector<double> extent;                ///< (p) root mean square radius of the piece's object
  std::vector<std::uint32_t> seed;           ///< (p) the cell that each piece was grown from

  [[nodiscard]] std::size_t count() const { return region.size(); }
};

/// `region_of_basin` groups the basins that no neck separates, numbered from 0 by their first
/// basins; `object_of_basin` those that touch at all, by any number. `spacing` is the points' mean
/// λ. Seeds are chosen farthest first through the inside, so the pieces depend on the shape alone,
/// not on its pose or density. `on_piece` hears of each piece's seed and extent before it grows.
/// Cost: O(c log p) for p pieces.
[[nodiscard]] Pieces split_regions(const DelaunayComplex& complex, const Basins& basins,
                                   const std::vector<std::uint32_t>& region_of_basin,
                                   const std::vector<std::uint32_t>& object_of_basin,
                                   double spacing, int threads,
                                   const std::function<void(std::uint32_t, double)>& on_piece);

}  // namespace morsel
