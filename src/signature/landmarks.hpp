// A few hundred places spread evenly over the surface, and what each stands for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel {

/// Landmarks in the order in which they were chosen: any first few are spread evenly as well.
struct Landmarks {
  std::vector<std::uint32_t> owner;  ///< (n) the landmark nearest to each point
  std::vector<Vec3> position;        ///< (k) mean of the points that it owns
  std::vector<Vec3> normal;          ///< (k) of the plane through them; its sign means nothing
  std::vector<double> weight;        ///< (k) share of the points

  [[nodiscard]] std::size_t count() const { return position.size(); }
};

/// Chooses the point farthest from `center`, then again and again the one farthest from all chosen:
/// a choice that depends on the shape alone, not on its pose. Fewer than `count` when there are
/// fewer distinct points. Cost: O(n log count) on surfaces.
/// Source: T. Gonzalez, "Clustering to Minimize the Maximum Intercluster Distance", Theoretical
/// Computer Science 38, 1985.
[[nodiscard]] Landmarks find_landmarks(std::span<const Vec3> points, const Vec3& center,
                                       std::size_t count);

}  // namespace morsel
