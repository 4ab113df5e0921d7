#pragma once

#include <algorithm>
#include <cmath>

namespace morsel {

/// The power of two that brings `size`, which is not negative, near 1, so that squares and products
/// neither overflow nor vanish; scaling by it rounds nothing. 1 for 0.
inline double unit_scale(double size) {
  constexpr int kMost = 1000;  // a double too
  return size > 0.0 ? std::ldexp(1.0, std::clamp(-std::ilogb(size), -kMost, kMost)) : 1.0;
}

}  // namespace morsel
