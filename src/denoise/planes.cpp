#include "denoise/planes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "base/threads.hpp"

namespace morsel {

Scatter::Axis Scatter::shortest() const {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(sum_);
  const Eigen::Vector3d direction = solver.eigenvectors().col(0);
  return {{direction.x(), direction.y(), direction.z()}, std::max(solver.eigenvalues()[0], 0.0)};
}

Planes fit_planes(std::span<const Vec3> points, const Neighborhoods& neighborhoods,
                  std::size_t size, int threads) {
  Planes planes;
  planes.normal.resize(points.size());
  planes.residual.resize(points.size());
  const auto fit = [&](std::size_t i) {
    const auto all = neighborhoods.of(i);
    const auto neighbors = all.first(std::min(size, all.size()));
    const LocalPlane plane = fit_local_plane(neighbors.size() + 1, [&](std::size_t k) {
      return k == 0 ? Vec3{} : points[neighbors[k - 1]] - points[i];
    });
    planes.normal[i] = plane.normal;
    planes.residual[i] = plane.residual;
  };
  parallel_ranges(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) fit(i);
  });
  return planes;
}

}  // namespace morsel
