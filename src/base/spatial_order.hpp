// A canonical order of points that depends on their coordinates alone and keeps neighbours close.
#pragma once

#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel {

/// The distinct points in canonical order and where each input point went.
struct SpatialOrder {
  std::vector<Vec3> points;                   ///< (v, 3) distinct, along a Morton curve
  std::vector<std::uint32_t> order_of_point;  ///< (n) index into `points` of each input point
};

/// Sorts by Morton code of the bounding cube, ties by coordinates; repeated points are kept once.
/// -0.0 counts as 0.0. Throws Error(kInput) for 2^31 points or more, and naming the index of a
/// point that is not finite: every stage that takes bare points begins here.
/// Cost: O(n log n), O(n) where they are in order already.
[[nodiscard]] SpatialOrder sort_spatially(std::span<const Vec3> points, int threads = 1);

/// Every k-th, `most` at most: of points along the curve, evenly from everywhere.
[[nodiscard]] std::vector<Vec3> evenly_chosen(std::span<const Vec3> points, std::size_t most);

}  // namespace morsel
