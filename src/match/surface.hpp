// What a Surface holds.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <morsel/partial.hpp>
#include <morsel/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/point_tree.hpp"

namespace morsel {

[[nodiscard]] inline Eigen::Map<const Eigen::Vector3d> as_vector(const Vec3& v) {
  return Eigen::Map<const Eigen::Vector3d>(&v.x);
}
[[nodiscard]] inline Vec3 as_point(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Area around a landmark, by distance × height above its plane × angle between the normals, as
/// square roots of shares of the disc of that radius: no sign of a normal matters.
inline constexpr std::size_t kDistanceBins = 5;
inline constexpr std::size_t kHeightBins = 3;
inline constexpr std::size_t kAngleBins = 3;
using Surroundings = std::array<float, kDistanceBins * kHeightBins * kAngleBins>;

/// A piece may be so much smaller than the whole: the surroundings of the piece at the first radius
/// recur at that of the whole at one of these.
inline constexpr std::size_t kScales = 6;
inline constexpr double kScaleStep = 1.3;

struct Surface::Data {
  std::vector<Vec3> points;   ///< (k) distinct
  std::vector<Vec3> normals;  ///< (k) unit; their signs mean nothing
  std::vector<int> parts;     ///< (k)
  std::vector<double> areas;  ///< (k) that each stands for, in squared units
  Vec3 center;                ///< mean of the points
  double size = 0.0;          ///< their RMS distance from it; 0: too few points to be a surface
  double spacing = 0.0;       ///< mean distance of neighbours
  std::vector<std::uint32_t> landmarks;  ///< points; any first few are spread evenly as well
  std::array<std::vector<Surroundings>, kScales> surroundings;  ///< (landmarks) at each scale
  std::optional<PointTree> tree;                                ///< of the points
};

/// Radius of the surroundings, in units.
[[nodiscard]] double radius_at(const Surface::Data& surface, std::size_t scale);

}  // namespace morsel
