// Which points of a cloud go on: no outliers, and of many those that are evenly spread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

#include "base/neighborhoods.hpp"

namespace morsel {

/// A cloud of n points without its outliers, k points, and the m of those that go on.
struct Cover {
  std::vector<Vec3> points;             ///< (k) those that are no outliers, in their order
  std::vector<std::uint32_t> kept;      ///< (m) indices into `points`, ascending
  std::vector<std::uint32_t> by;        ///< (k) index into `kept`: of a near one, or of itself
  Neighborhoods neighborhoods;          ///< (m) of those kept among `points`; outliers are replaced
                                        ///< by the point itself
  std::vector<bool> is_outlier;         ///< (n)
  std::vector<std::uint32_t> stand_in;  ///< (n) index into `kept`, of outliers too
  double far = 0.0;                     ///< what is so far from all others is an outlier, in units

  /// (m) Those that go on.
  [[nodiscard]] std::vector<Vec3> kept_points() const {
    std::vector<Vec3> result;
    result.reserve(kept.size());
    for (const std::uint32_t i : kept) result.push_back(points[i]);
    return result;
  }
  /// m / k; 1 of none.
  [[nodiscard]] double kept_share() const {
    return points.empty() ? 1.0
                          : static_cast<double>(kept.size()) / static_cast<double>(points.size());
  }
};

/// Sets outliers apart and keeps about `most` of the other points, or all if there are no more. A
/// point is an outlier if its `size` nearest neighbours are several times farther away than those
/// of the cloud at large, or than their own neighbours'. None that is kept is close to another for
/// the density around it: each that is not within some radius of one kept before is kept. Within
/// that radius lie as many points as `most` asks for; the distance to the farthest neighbour tells
/// it, and how thick the cloud is. `points` are distinct. Cost: O(n + m log n); on one thread if
/// not all are kept, as what is looked at depends on what was kept.
[[nodiscard]] Cover cover_cloud(std::span<const Vec3> points, std::size_t most, std::size_t size,
                                int threads);

}  // namespace morsel
