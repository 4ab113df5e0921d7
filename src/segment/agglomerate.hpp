// Joins pieces, the cheapest pair first.
#pragma once

#include <cstdint>
#include <morsel/segment.hpp>
#include <vector>

#include "segment/pieces.hpp"
#include "segment/sight.hpp"

namespace morsel {

/// Where two pieces touch.
struct PieceContact {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  double ratio = 1.0;      ///< merge ratio of their regions
  double area = 0.0;       ///< of the facets that they share, in squared units
  double facets = 0.0;     ///< number of them
  double concavity = 0.0;  ///< sum over them of their corners' mean concavity
  double creased = 0.0;    ///< sum over them of the share of their corners that lies in a crease
};

/// What the cost of joining pieces is made of.
struct PieceGraph {
  std::vector<PieceContact> contacts;
  std::vector<double> point_count;   ///< (p)
  std::vector<double> object_count;  ///< (p) points of the object that each piece belongs to
  std::vector<double>
      object_radius;              ///< (p) of the ball with as much surface as that object, in units
  std::vector<double> thickness;  ///< (p) radius of its largest ball, in units
  std::vector<double> surface;    ///< (p) area of its facets to the outside, in squared units
};

/// All merges in their order, with ratios that never fall; `significant` is left to the caller.
/// Cost: O(p²) memory, O(p² log p) time for few neighbours a piece.
[[nodiscard]] std::vector<Merge> agglomerate(const PieceGraph& graph, const SightTable& sight);

/// The ratio beyond which pieces stay apart by default.
[[nodiscard]] double natural_merge_ratio();

}  // namespace morsel
