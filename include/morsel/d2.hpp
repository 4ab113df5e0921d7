// morsel: the D2 shape distribution, a baseline to compare with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel {

/// How the shape distribution is taken.
struct D2Options {
  std::size_t bins = 64;       ///< 2 … 4096, up to three mean distances
  std::size_t pairs = 200000;  ///< random pairs of points, >= 1
  std::uint64_t seed = 1;      ///< of the portable generator
  int threads = 0;             ///< 0: all cores. The result does not depend on it.

  /// Throws Error(kUsage) that names field, value and range.
  void check() const;
};

/// Histogram (bins) of the distances of random pairs of points (n, 3), over their mean distance;
/// adds up to 1. Empty for fewer than two distinct points.
/// Source: R. Osada, T. Funkhouser, B. Chazelle, D. Dobkin, "Shape Distributions", ACM TOG 2002.
/// Differs: a point is drawn by the area that it stands for, the squared distance to its twelfth
/// nearest neighbour, so that uneven sampling does not show. Cost: O(n log n).
[[nodiscard]] std::vector<double> d2_distribution(std::span<const Vec3> points,
                                                  const D2Options& options = {});

/// L1 distance of two distributions, 0 … 2. Throws Error(kUsage) for unequal numbers of bins.
[[nodiscard]] double d2_distance(std::span<const double> a, std::span<const double> b);

}  // namespace morsel
