#include "denoise/thin.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/quantile.hpp"
#include "base/threads.hpp"
#include "denoise/planes.hpp"

namespace morsel {
namespace {

// Neighbourhoods that are looked at, spread evenly over the cloud.
constexpr std::size_t kSamples = 512;
constexpr std::size_t kNeighbors = 48;
// Neighbours are looked for among so many before and after along the curve: most of the nearest.
constexpr std::size_t kWindow = 256;
// Roughness of the flattest fifth: 0.13 at 20,000 points of the development shapes with noise of
// 0.3% of the diagonal, 0.18 with 0.5%, 0.25 where neighbourhoods are balls.
constexpr double kRough = 0.2;

// How far the nearest neighbours of a point lie off their plane, as a share of how far they reach:
// of the points `stride` apart, around the one of that rank.
double roughness(std::span<const Vec3> points, std::size_t stride, std::size_t rank) {
  const std::size_t count = points.size() / stride;
  const std::size_t begin = rank > kWindow ? rank - kWindow : 0;
  const std::size_t end = std::min(rank + kWindow, count);
  std::vector<Vec3> offsets;
  for (std::size_t i = begin; i < end; ++i) {
    offsets.push_back(points[i * stride] - points[rank * stride]);
  }
  const auto last =
      offsets.begin() + static_cast<std::ptrdiff_t>(std::min(kNeighbors, offsets.size() - 1));
  std::ranges::nth_element(offsets, last, {}, [](const Vec3& d) { return squared_norm(d); });
  const auto count_near = static_cast<std::size_t>(last - offsets.begin()) + 1;
  const LocalPlane plane = fit_local_plane(count_near, [&](std::size_t k) { return offsets[k]; });
  const double rough = plane.residual / norm(*last);
  return std::isfinite(rough) ? rough : 0.0;  // squares may overflow or vanish
}

bool surface_shows(std::span<const Vec3> points, std::size_t stride, int threads) {
  const std::size_t count = points.size() / stride;
  std::vector<double> rough(kSamples);
  parallel_rows(kSamples, threads,
                [&](std::size_t i) { rough[i] = roughness(points, stride, i * count / kSamples); });
  return quantile(rough, 0.2) < kRough;
}

}  // namespace

std::size_t useful_points(std::span<const Vec3> ordered, int threads) {
  std::size_t stride = 1;
  while (ordered.size() / (2 * stride) >= kSamples && !surface_shows(ordered, stride, threads)) {
    stride *= 2;
  }
  return ordered.size() / stride;
}

}  // namespace morsel
