// The nearest neighbours of single points of a cloud.
#pragma once

#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

#include "base/point_tree.hpp"

namespace morsel {

/// Looks for neighbours of one point after the other; many threads may at once.
class NeighborSearch {
 public:
  /// So many neighbours can be asked for.
  static constexpr std::size_t kMost = 63;

  /// `points` are distinct. Cost: O(n log n).
  explicit NeighborSearch(std::span<const Vec3> points);

  /// Fills `nearest`, at most kMost and fewer than there are points, with the other points nearest
  /// to the one named, nearest first. Returns how far the last of them is, in units.
  /// Cost: O(log n).
  double find(std::uint32_t point, std::span<std::uint32_t> nearest) const;

 private:
  double scale_;
  std::vector<Vec3> points_;
  PointTree tree_;
};

}  // namespace morsel
