// The nearest of a set of points.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <nanoflann.hpp>
#include <span>

namespace morsel {

/// A k-d tree over points that outlive it; there is at least one.
class PointTree {
 public:
  struct Hit {
    std::uint32_t index = 0;
    double distance = 0.0;
  };

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

    // NOLINTBEGIN(readability-identifier-naming): the names that nanoflann calls.
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t index, std::size_t axis) const {
      const Vec3& p = points[index];
      return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    }
    template <class Box>
    bool kdtree_get_bbox(Box& /*box*/) const {
      return false;
    }
    // NOLINTEND(readability-identifier-naming)
  };
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>,
                                                   Cloud, 3, std::uint32_t>;

  Cloud cloud_;
  Tree tree_;
};

}  // namespace morsel
