// From sampled fields to closed outlines.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace morsel::picture {

/// Values at the nodes of a grid, rows from the top; the inside is where they are positive.
struct Field {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<float> values;
};

using Loop = std::vector<Eigen::Vector2f>;  ///< a closed polygon, in nodes from the top left

/// The outlines of the field's inside; holes run the other way round. Outside the grid the field
/// counts as negative. Cost: O(nodes).
[[nodiscard]] std::vector<Loop> trace_contours(const Field& field);

/// Drops corners that lie within `tolerance` of the line through those kept.
[[nodiscard]] Loop simplify(const Loop& loop, float tolerance);

/// Enclosed area in square nodes, of either sign.
[[nodiscard]] float signed_area(const Loop& loop);

}  // namespace morsel::picture
