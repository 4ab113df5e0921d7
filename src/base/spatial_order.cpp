#include "base/spatial_order.hpp"

#include <algorithm>
#include <memory>
#include <morsel/error.hpp>
#include <string>
#include <tuple>

#include "base/box.hpp"
#include "base/cancel.hpp"
#include "base/morton.hpp"
#include "base/threads.hpp"

namespace morsel {
namespace {

struct Entry {
  std::uint64_t code;
  std::uint32_t index;
};

std::uint64_t quantize(double value, double low, double scale) {
  constexpr double kLast = 2097151.0;  // 2^21 - 1
  if (scale == 0.0) return 0;          // the difference may be infinite, and its product undefined
  return static_cast<std::uint64_t>(std::clamp((value - low) * scale, 0.0, kLast));
}

// Where codes are equal, which is rare but for repeated points, coordinates decide.
class Before {
 public:
  explicit Before(std::span<const Vec3> points) : points_(points) {}

  bool operator()(const Entry& a, const Entry& b) const {
    return a.code != b.code ? a.code < b.code : by_coordinates(a.index, b.index);
  }

 private:
  [[nodiscard]] bool by_coordinates(std::uint32_t a, std::uint32_t b) const {
    const Vec3& p = points_[a];
    const Vec3& q = points_[b];
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  }

  std::span<const Vec3> points_;
};

Box checked_box(std::span<const Vec3> points) {
  if (points.size() >= (std::size_t{1} << 31)) {
    throw Error(ErrorCode::kInput, "more than 2^31 points; thin the cloud first");
  }
  Box box;
  in_turn(points.size(), [&](std::size_t i) {
    if (!is_finite(points[i])) {
      throw Error(ErrorCode::kInput, "point " + std::to_string(i) +
                                         " is not finite; remove it or mend its coordinates");
    }
    box.add(points[i]);
  });
  return box;
}

// One for each point, in memory that is not filled with zeros first: of millions that takes long.
std::unique_ptr<Entry[]> sorted_entries(std::span<const Vec3> points, int threads) {
  const Box box = checked_box(points);
  const Vec3 low = box.low;
  const double extent = box.longest_side();
  const double scale = extent > 0.0 && extent < 1e300 ? 2097152.0 / extent : 0.0;
  auto memory = std::make_unique_for_overwrite<Entry[]>(points.size());
  const std::span entries(memory.get(), points.size());
  parallel_ranges(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& p = points[i];
      entries[i] = {spread_bits(quantize(p.x, low.x, scale)) << 2 |
                        spread_bits(quantize(p.y, low.y, scale)) << 1 |
                        spread_bits(quantize(p.z, low.z, scale)),
                    static_cast<std::uint32_t>(i)};
    }
  });
  // What comes from an earlier stage mostly is in order already.
  const Before before(points);
  if (!std::ranges::is_sorted(entries, before)) parallel_sort(entries, threads, before);
  return memory;
}

}  // namespace

SpatialOrder sort_spatially(std::span<const Vec3> points, int threads) {
  const std::unique_ptr<Entry[]> entries = sorted_entries(points, threads);
  SpatialOrder order;
  order.points.reserve(points.size());
  order.order_of_point.resize(points.size());
  in_turn(points.size(), [&](std::size_t i) {
    const std::uint32_t index = entries[i].index;
    const Vec3 point = points[index] + Vec3{0.0, 0.0, 0.0};  // -0.0 becomes 0.0
    if (order.points.empty() || !(order.points.back() == point)) order.points.push_back(point);
    order.order_of_point[index] = static_cast<std::uint32_t>(order.points.size() - 1);
  });
  return order;
}

std::vector<Vec3> evenly_chosen(std::span<const Vec3> points, std::size_t most) {
  std::vector<Vec3> chosen;
  const std::size_t count = std::min(most, points.size());
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(points[i * points.size() / count]);
  return chosen;
}

}  // namespace morsel
