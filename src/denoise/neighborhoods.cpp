#include "denoise/neighborhoods.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nanoflann.hpp>

#include "base/threads.hpp"

namespace morsel {
namespace {

// What nanoflann asks of a container of points; the names are its own.
class PointAdaptor {
 public:
  explicit PointAdaptor(std::span<const Vec3> points) : points_(points) {}
  // NOLINTBEGIN(readability-identifier-naming)
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points_.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    const Vec3& p = points_[index];
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  }
  template <typename Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
  // NOLINTEND(readability-identifier-naming)

 private:
  std::span<const Vec3> points_;
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointAdaptor>,
                                                 PointAdaptor, 3, std::uint32_t>;

}  // namespace

Neighborhoods find_neighborhoods(std::span<const Vec3> points, std::size_t size, int threads) {
  Neighborhoods result;
  result.size = std::min(size, points.empty() ? 0 : points.size() - 1);
  result.indices.resize(points.size() * result.size);
  result.reach.resize(points.size());
  if (result.size == 0) return result;
  const PointAdaptor adaptor(points);
  const Tree tree(3, adaptor);
  parallel_ranges(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> found(result.size + 1);
    std::vector<double> squared(result.size + 1);
    for (std::size_t i = begin; i < end; ++i) {
      const std::array<double, 3> query{points[i].x, points[i].y, points[i].z};
      tree.knnSearch(query.data(), found.size(), found.data(), squared.data());
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
  const PointAdaptor adaptor(points);
  const Tree tree(3, adaptor);
  parallel_ranges(queries.size(), threads, [&](std::size_t begin, std::size_t end) {
    double squared = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const std::array<double, 3> query{queries[i].x, queries[i].y, queries[i].z};
      tree.knnSearch(query.data(), 1, &nearest[i], &squared);
    }
  });
  return nearest;
}

}  // namespace morsel
