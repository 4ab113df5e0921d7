// morsel: outliers set apart, noise measured and, where it pays, smoothed away before
// triangulating.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <morsel/progress.hpp>
#include <morsel/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace morsel {

/// Stands for "no point": what answers for points of the ground.
inline constexpr std::uint32_t kNoStandIn = 0xffffffffU;

/// How to treat noise.
struct DenoiseOptions {
  /// Rounds of smoothing, 0 … 20. Not given: the noise is estimated and the program decides.
  /// Outliers are set apart in any case.
  std::optional<int> rounds;
  int threads = 0;  ///< 0: all cores. The result does not depend on it.
  /// Of more points about so many go on, spread evenly; >= 1. segment() chooses it.
  std::size_t most_points = std::numeric_limits<std::size_t>::max();

  /// Throws Error(kUsage) that names field, value and range.
  void check() const;
};

/// The points that go on to the triangulation.
struct Denoised {
  std::vector<Vec3> points;  ///< (m, 3) distinct, along the canonical order, outliers left
                             ///< out, moved where smoothing moved them
  std::vector<std::uint32_t> stand_in;  ///< (n) index into `points` for each input point: its own,
                                        ///< for one left out that of the nearest point kept;
                                        ///< kNoStandIn in a Segmentation for the ground's
  double noise = 0.0;    ///< estimated standard deviation across the surface, in units
  double spacing = 0.0;  ///< median distance to the twelfth nearest neighbour, in units
  int rounds = 0;        ///< of smoothing that were done
  /// (k, 3) the points looked at that are no outliers, and the index into `points` of one near
  /// each; empty if all of them are in `points`, or those were moved.
  std::vector<Vec3> samples;
  std::vector<std::uint32_t> near_sample;
  double kept_share = 1.0;  ///< of the points looked at, 0 … 1: the others lay near one of `points`
  std::size_t outlier_count = 0;  ///< input points that were set apart
};

/// Sets apart points far from all others, estimates the noise from how far points lie off the
/// planes through their neighbours and, when it is large against the spacing, moves each point
/// along its normal onto the surface that its neighbours agree on (bilateral smoothing). Throws
/// Error(kInput) for a coordinate that is not finite, Error(kCancelled). Cost: O(n log n);
/// independent of the order of the points and of the number of threads.
[[nodiscard]] Denoised denoise(std::span<const Vec3> points, const DenoiseOptions& options = {},
                               const Progress* progress = nullptr);

}  // namespace morsel
