#include "denoise/smooth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantile.hpp"
#include "base/threads.hpp"
#include "denoise/neighborhoods.hpp"
#include "denoise/planes.hpp"

namespace morsel {
namespace {

// Tuned on the development shapes with ids ≡ 1 mod 4 at noise of 0.3% and 0.5% of the diagonal.
constexpr std::size_t kNeighbors = 40;
constexpr std::size_t kPlaneNeighbors = 24;
constexpr int kNormalRounds = 3;
// Widths of the weights: of the distance, in reaches of the neighbourhood; of 1 - |cos| between
// normals; of the distance from the plane, in medians of the planes' residuals.
constexpr double kDistanceWidth = 0.5;
constexpr double kNormalWidth = 0.3;
constexpr double kHeightWidth = 2.0;

// exp(-x) but for its tail, and cheaper.
double falloff(double x) {
  const double base = std::max(1.0 - 0.125 * x, 0.0);
  const double fourth = base * base * base * base;
  return fourth * fourth;
}

// How much a neighbour counts.
class Weights {
 public:
  Weights(double reach, double height_width)
      : distance_(0.5 / (kDistanceWidth * kDistanceWidth * reach * reach)),
        height_(0.5 / (height_width * height_width)) {}

  [[nodiscard]] double operator()(double squared_distance, double cosine, double height) const {
    constexpr double kNormal = 0.5 / (kNormalWidth * kNormalWidth);
    const double turn = 1.0 - std::abs(cosine);
    return falloff(distance_ * squared_distance + kNormal * turn * turn +
                   height_ * height * height);
  }

 private:
  double distance_;
  double height_;
};

// Points with their normals and neighbours; `height_width` tells noise from another sheet.
struct Field {
  const std::vector<Vec3>& points;
  const Neighborhoods& neighborhoods;
  double height_width;
  int threads;
};

// Each normal becomes the mean of those around it, turned to its side.
std::vector<Vec3> filter_normals(const Field& field, const std::vector<Vec3>& normals) {
  std::vector<Vec3> filtered(normals.size());
  const auto filter = [&](std::size_t i) {
    const Weights weights(field.neighborhoods.reach[i], field.height_width);
    Vec3 sum = normals[i];
    for (const std::uint32_t j : field.neighborhoods.of(i)) {
      const Vec3 d = field.points[j] - field.points[i];
      const double cosine = dot(normals[i], normals[j]);
      const double weight = weights(dot(d, d), cosine, dot(normals[i], d));
      sum = sum + (weight * cosine) * normals[j];
    }
    filtered[i] = (1.0 / norm(sum)) * sum;  // its component along normals[i] is 1 at least
  };
  parallel_ranges(normals.size(), field.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) filter(i);
  });
  return filtered;
}

std::vector<Vec3> move_points(const Field& field, const std::vector<Vec3>& normals) {
  std::vector<Vec3> moved(normals.size());
  const auto move = [&](std::size_t i) {
    const Weights weights(field.neighborhoods.reach[i], field.height_width);
    double total = 1.0;
    double sum = 0.0;
    for (const std::uint32_t j : field.neighborhoods.of(i)) {
      const Vec3 d = field.points[j] - field.points[i];
      const double cosine = dot(normals[i], normals[j]);
      const double along = dot(normals[j], d);
      const double height = 0.5 * (dot(normals[i], d) + (cosine < 0.0 ? -along : along));
      const double weight = weights(dot(d, d), cosine, height);
      total += weight;
      sum += weight * height;
    }
    moved[i] = field.points[i] + (sum / total) * normals[i];
  };
  parallel_ranges(normals.size(), field.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) move(i);
  });
  return moved;
}

}  // namespace

void smooth(std::vector<Vec3>& points, int rounds, int threads) {
  Neighborhoods neighborhoods;
  double height_width = 0.0;
  for (int round = 0; round < rounds; ++round) {
    // Neighbours are found anew once: the first round moves the points most.
    if (round < 2) neighborhoods = find_neighborhoods(points, kNeighbors, threads);
    Planes planes = fit_planes(points, neighborhoods, kPlaneNeighbors, threads);
    if (round == 0) height_width = kHeightWidth * quantile(planes.residual, 0.5);
    if (height_width <= 0.0) return;  // half of the cloud lies on planes
    const Field field{points, neighborhoods, height_width, threads};
    std::vector<Vec3> normals = std::move(planes.normal);
    for (int i = 0; i < kNormalRounds; ++i) normals = filter_normals(field, normals);
    points = move_points(field, normals);
  }
}

}  // namespace morsel
