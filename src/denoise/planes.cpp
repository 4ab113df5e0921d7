#include "denoise/planes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "base/threads.hpp"

namespace morsel {

Scatter::Axis Scatter::shortest() const {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(sum_);
  const Eigen::Vector3d direction = solver.eigenvectors().col(0);
  return {{direction.x(), direction.y(), direction.z()}, std::max(solver.eigenvalues()[0], 0.0)};
}

LocalPlane plane_at(std::span<const Vec3> points, std::uint32_t point,
                    std::span<const std::uint32_t> neighbors) {
  return fit_local_plane(neighbors.size() + 1, [&](std::size_t k) {
    return k == 0 ? Vec3{} : points[neighbors[k - 1]] - points[point];
  });
}

Planes fit_planes(std::span<const Vec3> points, std::span<const std::uint32_t> of,
                  const Neighborhoods& neighborhoods, std::size_t size, int threads) {
  Planes planes;
  planes.normal.resize(of.size());
  planes.residual.resize(of.size());
  parallel_ranges(of.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto all = neighborhoods.of(i);
      const LocalPlane plane = plane_at(points, of[i], all.first(std::min(size, all.size())));
      planes.normal[i] = plane.normal;
      planes.residual[i] = plane.residual;
    }
  });
  return planes;
}

Planes fit_planes(std::span<const Vec3> points, const Neighborhoods& neighborhoods,
                  std::size_t size, int threads) {
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  return fit_planes(points, all, neighborhoods, size, threads);
}

}  // namespace morsel
