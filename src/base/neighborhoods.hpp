// The nearest neighbours of every point of a cloud.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel {

/// For each point its `size` nearest other points and how far they are; of equally near ones those
/// with smaller indices.
struct Neighborhoods {
  std::size_t size = 0;                ///< k, fewer than asked when there are not enough points
  std::vector<std::uint32_t> indices;  ///< (n, k), in an order that depends on the points alone
  std::vector<double> reach;           ///< (n) distance to the farthest of them, in units

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t point) const {
    return std::span(indices).subspan(point * size, size);
  }
};

/// `points` are distinct. The `inner` nearest come before the others. Cost: O(n log n).
[[nodiscard]] Neighborhoods find_neighborhoods(std::span<const Vec3> points, std::size_t size,
                                               int threads, std::size_t inner);
[[nodiscard]] inline Neighborhoods find_neighborhoods(std::span<const Vec3> points,
                                                      std::size_t size, int threads) {
  return find_neighborhoods(points, size, threads, size);
}

/// Likewise of some of the points: a row for each of `of`, which names none twice. Cost: that of
/// laying out all points, O(n log n), and O(log n) for each.
[[nodiscard]] Neighborhoods find_neighborhoods_of(std::span<const std::uint32_t> of,
                                                  std::span<const Vec3> points, std::size_t size,
                                                  int threads, std::size_t inner);

/// The three least of some distances.
class ThreeLeast {
 public:
  void add(double distance) {
    for (double& held : held_) {
      const double larger = std::max(held, distance);
      held = std::min(held, distance);
      distance = larger;
    }
    ++added_;
  }
  [[nodiscard]] std::size_t count() const { return std::min(added_, held_.size()); }
  /// Of as many as there are, at least one.
  [[nodiscard]] double mean() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < count(); ++k) sum += held_[k];
    return sum / static_cast<double>(count());
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  std::array<double, 3> held_{kNone, kNone, kNone};  // ascending
  std::size_t added_ = 0;
};

/// For each query the index of the nearest of `points`, which is not empty.
[[nodiscard]] std::vector<std::uint32_t> find_nearest(std::span<const Vec3> points,
                                                      std::span<const Vec3> queries, int threads);

}  // namespace morsel
