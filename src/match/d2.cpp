#include <algorithm>
#include <cmath>
#include <morsel/d2.hpp>
#include <morsel/error.hpp>
#include <string>

#include "base/neighborhoods.hpp"
#include "base/random.hpp"
#include "base/spatial_order.hpp"

namespace morsel {
namespace {

constexpr std::size_t kNeighbors = 12;
constexpr double kFarthest = 3.0;  // mean distances

// Running sums of the areas that the points stand for.
std::vector<double> cumulated_areas(std::span<const Vec3> points, int threads) {
  std::vector<double> sums = find_neighborhoods(points, kNeighbors, threads).reach;
  double sum = 0.0;
  for (double& reach : sums) reach = sum += reach * reach;
  return sums;
}

const Vec3& draw(const std::vector<Vec3>& points, const std::vector<double>& sums, Random& random) {
  const auto at = std::ranges::upper_bound(sums, random.uniform() * sums.back());
  return points[std::min(static_cast<std::size_t>(at - sums.begin()), points.size() - 1)];
}

}  // namespace

void D2Options::check() const {
  if (bins < 2 || bins > 4096) {
    throw Error(ErrorCode::kUsage,
                "D2Options.bins is " + std::to_string(bins) + "; expected 2 to 4096");
  }
  if (pairs < 1) throw Error(ErrorCode::kUsage, "D2Options.pairs is 0; expected at least 1");
}

std::vector<double> d2_distribution(std::span<const Vec3> points, const D2Options& options) {
  options.check();
  const std::vector<Vec3> distinct = sort_spatially(points).points;
  if (distinct.size() < 2) return {};
  const std::vector<double> sums = cumulated_areas(distinct, options.threads);
  Random random(options.seed);
  std::vector<double> distances(options.pairs);
  double mean = 0.0;
  for (double& d : distances) {
    const Vec3& a = draw(distinct, sums, random);
    d = distance(a, draw(distinct, sums, random));
    mean += d / static_cast<double>(options.pairs);
  }
  std::vector<double> histogram(options.bins, 0.0);
  for (const double d : distances) {
    const double at = mean > 0.0 ? d / (kFarthest * mean) * static_cast<double>(options.bins) : 0.0;
    histogram[std::min(static_cast<std::size_t>(at), options.bins - 1)] +=
        1.0 / static_cast<double>(options.pairs);
  }
  return histogram;
}

double d2_distance(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) {
    throw Error(ErrorCode::kUsage, "D2 distributions of " + std::to_string(a.size()) + " and " +
                                       std::to_string(b.size()) + " bins cannot be compared");
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum;
}

}  // namespace morsel
