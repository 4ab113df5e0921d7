#include "base/spatial_order.hpp"

#include <algorithm>
#include <functional>
#include <morsel/error.hpp>
#include <string>
#include <tuple>

#include "base/box.hpp"
#include "base/morton.hpp"
#include "base/threads.hpp"

namespace morsel {
namespace {

struct Entry {
  std::uint64_t code;
  Vec3 point;
  std::uint32_t index;
};

std::uint64_t quantize(double value, double low, double scale) {
  constexpr double kLast = 2097151.0;  // 2^21 - 1
  if (scale == 0.0) return 0;          // the difference may be infinite, and its product undefined
  return static_cast<std::uint64_t>(std::clamp((value - low) * scale, 0.0, kLast));
}

bool operator<(const Entry& a, const Entry& b) {
  if (a.code != b.code) return a.code < b.code;
  return std::tie(a.point.x, a.point.y, a.point.z, a.index) <
         std::tie(b.point.x, b.point.y, b.point.z, b.index);
}

void check_points(std::span<const Vec3> points) {
  if (points.size() >= (std::size_t{1} << 31)) {
    throw Error(ErrorCode::kInput, "more than 2^31 points; thin the cloud first");
  }
  const auto bad = std::ranges::find_if_not(points, is_finite);
  if (bad == points.end()) return;
  throw Error(ErrorCode::kInput, "point " + std::to_string(bad - points.begin()) +
                                     " is not finite; remove it or mend its coordinates");
}

std::vector<Entry> sorted_entries(std::span<const Vec3> points, int threads) {
  const Box box = bounding_box(points);
  const Vec3 low = box.low;
  const double extent = box.longest_side();
  const double scale = extent > 0.0 && extent < 1e300 ? 2097152.0 / extent : 0.0;
  std::vector<Entry> entries(points.size());
  parallel_ranges(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 p = points[i] + Vec3{0.0, 0.0, 0.0};  // -0.0 becomes 0.0
      entries[i] = {spread_bits(quantize(p.x, low.x, scale)) << 2 |
                        spread_bits(quantize(p.y, low.y, scale)) << 1 |
                        spread_bits(quantize(p.z, low.z, scale)),
                    p, static_cast<std::uint32_t>(i)};
    }
  });
  // A cloud without outliers comes here once in order already.
  if (!std::ranges::is_sorted(entries, std::less<>())) parallel_sort(entries, threads);
  return entries;
}

}  // namespace

SpatialOrder sort_spatially(std::span<const Vec3> points, int threads) {
  check_points(points);
  SpatialOrder order;
  order.points.reserve(points.size());
  order.order_of_point.resize(points.size());
  const std::vector<Entry> entries = sorted_entries(points, threads);
  in_turn(entries.size(), [&](std::size_t i) {
    const Entry& entry = entries[i];
    if (order.points.empty() || !(order.points.back() == entry.point)) {
      order.points.push_back(entry.point);
    }
    order.order_of_point[entry.index] = static_cast<std::uint32_t>(order.points.size() - 1);
  });
  return order;
}

}  // namespace morsel
