// Joins pieces, the cheapest pair first.
#pragma once

#include <morsel/segment.hpp>
#include <vector>

#include "segment/pieces.hpp"
#include "segment/sight.hpp"

namespace morsel {

/// What the cost of joining pieces is made of.
struct PieceGraph {
  std::vector<Neck> contacts;        ///< touching pieces; `radius` holds the merge ratio of the two
  std::vector<double> point_count;   ///< (p)
  std::vector<double> object_count;  ///< (p) points of the object that each piece belongs to
  std::vector<double> thickness;     ///< (p) radius of its largest ball, in units
};

/// All merges in their order, with ratios that never fall; `significant` is left to the caller.
/// Cost: O(p²) memory, O(p² log p) time for few neighbours a piece.
[[nodiscard]] std::vector<Merge> agglomerate(const PieceGraph& graph, const SightTable& sight);

/// The ratio beyond which pieces stay apart by default.
[[nodiscard]] double natural_merge_ratio();

}  // namespace morsel
