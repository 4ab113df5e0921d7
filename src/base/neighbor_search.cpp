#include "base/neighbor_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/unit_scale.hpp"

namespace morsel {
namespace {

std::vector<Vec3> scaled(std::span<const Vec3> points, double scale) {
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (const Vec3& p : points) result.push_back(scale * p);
  return result;
}

}  // namespace

NeighborSearch::NeighborSearch(std::span<const Vec3> points)
    : scale_(unit_scale(largest_coordinate(points))),
      points_(scaled(points, scale_)),
      tree_(points_) {}

double NeighborSearch::find(std::uint32_t point, std::span<std::uint32_t> nearest) const {
  std::array<std::uint32_t, kMost + 1> indices;
  std::array<double, kMost + 1> squared;
  const std::size_t count = nearest.size() + 1;
  tree_.find(points_[point], std::span(indices).first(count), std::span(squared).first(count));
  // The point itself comes first, unless others are so near that their distance vanishes.
  const std::span found = std::span(indices).first(count);
  const auto own = std::find(found.begin(), found.end() - 1, point);
  std::copy(own + 1, found.end(), std::copy(found.begin(), own, nearest.begin()));
  return std::sqrt(squared[count - 1]) / scale_;
}

}  // namespace morsel
