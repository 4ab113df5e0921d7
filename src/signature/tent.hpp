// Histograms without edges: a value is shared linearly between the two nearest bins, so a small
// change of the shape is a small change of the table.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace morsel {

struct Tent {
  std::size_t bin = 0;            ///< the lower one
  std::array<double, 2> share{};  ///< of this bin and the next
};

/// Where `position` in [0, 1] falls on an axis of `count` >= 2 bins; clamped to its ends. What is
/// no number, such as a place relative to a shape without extent, is at its beginning.
[[nodiscard]] inline Tent tent(double position, std::size_t count) {
  const double at = std::fmin(std::fmax(position * static_cast<double>(count) - 0.5, 0.0),
                              static_cast<double>(count - 1));
  const std::size_t bin = std::min(static_cast<std::size_t>(at), count - 2);
  const double high = at - static_cast<double>(bin);
  return {bin, {1.0 - high, high}};
}

}  // namespace morsel
