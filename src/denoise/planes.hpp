// Planes through neighbourhoods of a raw cloud.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

#include "base/neighborhoods.hpp"

namespace morsel {

/// Sum of d dᵀ over offsets d, and its shortest axis.
class Scatter {
 public:
  void add(const Vec3& d) {
    sum_(0, 0) += d.x * d.x;
    sum_(1, 0) += d.y * d.x;
    sum_(2, 0) += d.z * d.x;
    sum_(1, 1) += d.y * d.y;
    sum_(2, 1) += d.z * d.y;
    sum_(2, 2) += d.z * d.z;
  }

  struct Axis {
    Vec3 direction;  ///< unit; its sign means nothing
    double sum;      ///< of the squared offsets along it
  };
  [[nodiscard]] Axis shortest() const;

 private:
  Eigen::Matrix3d sum_ = Eigen::Matrix3d::Zero();  // lower triangle
};

/// A plane through points that are given by their offsets from one of them, or from any place near.
struct LocalPlane {
  Vec3 normal;      ///< unit; its sign means nothing
  double residual;  ///< root mean square distance of the points from it
};

/// Fits it to offset(0) … offset(count - 1). Cost: O(count).
template <typename Offset>
[[nodiscard]] LocalPlane fit_local_plane(std::size_t count, const Offset& offset) {
  Vec3 sum;
  for (std::size_t k = 0; k < count; ++k) sum = sum + offset(k);
  const auto size = static_cast<double>(count);
  const Vec3 mean = (1.0 / size) * sum;
  Scatter scatter;
  for (std::size_t k = 0; k < count; ++k) scatter.add(offset(k) - mean);
  const Scatter::Axis normal = scatter.shortest();
  return {normal.direction, std::sqrt(normal.sum / size)};
}

/// The plane through a point and some others.
[[nodiscard]] LocalPlane plane_at(std::span<const Vec3> points, std::uint32_t point,
                                  std::span<const std::uint32_t> neighbors);

/// The planes through some points and their nearest neighbours.
struct Planes {
  std::vector<Vec3> normal;      ///< (m) unit; their signs mean nothing
  std::vector<double> residual;  ///< (m) root mean square distance of the points from the plane
};

/// Fits them to the points named by `of`, m indices, and the `size` first of their neighbours, a
/// row for each of them. Cost: O(m · size).
[[nodiscard]] Planes fit_planes(std::span<const Vec3> points, std::span<const std::uint32_t> of,
                                const Neighborhoods& neighborhoods, std::size_t size, int threads);
/// Likewise to all points.
[[nodiscard]] Planes fit_planes(std::span<const Vec3> points, const Neighborhoods& neighborhoods,
                                std::size_t size, int threads);

}  // namespace morsel
