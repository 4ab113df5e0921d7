// The nearest of a set of points.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <nanoflann.hpp>
#include <span>

#include "base/cancel.hpp"

namespace morsel {

/// A k-d tree over points that outlive it; there is at least one.
class PointTree {
 public:
  struct Hit {
    std::uint32_t index = 0;
    double distance = 0.0;
  };

  /// Throws Error(kCancelled) when asked to stop (base/cancel.hpp).
  explicit PointTree(std::span<const Vec3> points) : cloud_{points}, tree_(3, cloud_) {}
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  [[nodiscard]] Hit nearest(const Vec3& query) const {
    Hit hit;
    double squared = 0.0;
    find(query, {&hit.index, 1}, {&squared, 1});
    hit.distance = std::sqrt(squared);
    return hit;
  }
  /// The nearest as many as `indices` takes, nearest first; there are as many points.
  void find(const Vec3& query, std::span<std::uint32_t> indices, std::span<double> squared) const {
    const double coordinates[3] = {query.x, query.y, query.z};
    tree_.knnSearch(coordinates, indices.size(), indices.data(), squared.data());
  }

 private:
  struct Cloud {
    std::span<const Vec3> points;
    mutable std::uint32_t read = 0;

    // NOLINTBEGIN(readability-identifier-naming): the names that nanoflann calls.
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    // While the tree is built, on one thread.
    [[nodiscard]] double kdtree_get_pt(std::size_t index, std::size_t axis) const {
      if (read++ % 65536 == 0) check_cancelled();
      const Vec3& p = points[index];
      return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    }
    template <class Box>
    bool kdtree_get_bbox(Box& /*box*/) const {
      return false;
    }
    // NOLINTEND(readability-identifier-naming)
  };
  // While it is searched, by any thread.
  struct SquaredDistance {
    // NOLINTBEGIN(readability-identifier-naming)
    using ElementType = double;
    using DistanceType = double;
    explicit SquaredDistance(const Cloud& of) : cloud(of) {}
    const Cloud& cloud;

    [[nodiscard]] double evalMetric(const double* a, std::uint32_t b, std::size_t /*size*/) const {
      return squared_distance({a[0], a[1], a[2]}, cloud.points[b]);
    }
    [[nodiscard]] double accum_dist(double a, double b, std::size_t /*axis*/) const {
      return (a - b) * (a - b);
    }
    // NOLINTEND(readability-identifier-naming)
  };
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<SquaredDistance, Cloud, 3, std::uint32_t>;

  Cloud cloud_;
  Tree tree_;
};

}  // namespace morsel
