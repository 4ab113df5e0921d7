#pragma once

#include <algorithm>
#include <cmath>
#include <morsel/vec3.hpp>
#include <span>

namespace morsel {

/// The power of two that brings `size`, which is not negative, near 1, so that squares and products
/// neither overflow nor vanish; scaling by it rounds nothing. 1 for 0.
inline double unit_scale(double size) {
  constexpr int kMost = 1000;  // a double too
  return size > 0.0 ? std::ldexp(1.0, std::clamp(-std::ilogb(size), -kMost, kMost)) : 1.0;
}

inline double largest_coordinate(std::span<const Vec3> points) {
  double largest = 0.0;
  for (const Vec3& p : points) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return largest;
}

}  // namespace morsel
