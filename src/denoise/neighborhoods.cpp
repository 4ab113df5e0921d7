#include "denoise/neighborhoods.hpp"

#include <algorithm>
#include <cmath>

#include "base/point_tree.hpp"
#include "base/threads.hpp"

namespace morsel {

Neighborhoods find_neighborhoods(std::span<const Vec3> points, std::size_t size, int threads) {
  Neighborhoods result;
  result.size = std::min(size, points.empty() ? 0 : points.size() - 1);
  result.indices.resize(points.size() * result.size);
  result.reach.resize(points.size());
  if (result.size == 0) return result;
  const PointTree tree(points);
  parallel_ranges(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> found(result.size + 1);
    std::vector<double> squared(result.size + 1);
    for (std::size_t i = begin; i < end; ++i) {
      tree.find(points[i], found, squared);
      // The point itself comes first, at distance 0: the points are distinct.
      std::copy(found.begin() + 1, found.end(), result.indices.begin() + i * result.size);
      result.reach[i] = std::sqrt(squared.back());
    }
  });
  return result;
}

std::vector<std::uint32_t> find_nearest(std::span<const Vec3> points, std::span<const Vec3> queries,
                                        int threads) {
  std::vector<std::uint32_t> nearest(queries.size());
  if (queries.empty()) return nearest;
  const PointTree tree(points);
  parallel_ranges(queries.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) nearest[i] = tree.nearest(queries[i]).index;
  });
  return nearest;
}

}  // namespace morsel
