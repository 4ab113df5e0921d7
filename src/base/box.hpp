// Axis-parallel boxes.
#pragma once

#include <algorithm>
#include <limits>
#include <morsel/vec3.hpp>
#include <span>

namespace morsel {

/// The corners; a box without points has infinite ones, `low` above `high`.
struct Box {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  Vec3 low{kInfinity, kInfinity, kInfinity};
  Vec3 high{-kInfinity, -kInfinity, -kInfinity};

  void add(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  [[nodiscard]] double diagonal() const { return distance(low, high); }
  [[nodiscard]] double longest_side() const {
    return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  }
};

/// The smallest box around the points. Those that are not finite do not count.
[[nodiscard]] inline Box bounding_box(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& p : points) {
    if (is_finite(p)) box.add(p);
  }
  return box;
}

}  // namespace morsel
