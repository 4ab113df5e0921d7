#include "base/spatial_order.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace morsel {
namespace {

struct Entry {
  std::uint64_t code;
  Vec3 point;
  std::uint32_t index;
};

// Spreads the lower 21 bits so that two zero bits follow each.
std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffULL;
  x = (x | x << 16) & 0x1f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  x = (x | x << 2) & 0x1249249249249249ULL;
  return x;
}

std::uint64_t quantize(double value, double low, double scale) {
  constexpr double kLast = 2097151.0;  // 2^21 - 1
  return static_cast<std::uint64_t>(std::clamp((value - low) * scale, 0.0, kLast));
}

bool before(const Entry& a, const Entry& b) {
  return std::tie(a.code, a.point.x, a.point.y, a.point.z) <
         std::tie(b.code, b.point.x, b.point.y, b.point.z);
}

std::vector<Entry> sorted_entries(std::span<const Vec3> points) {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high = -1.0 * low;
  for (const Vec3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const double scale = extent > 0.0 && extent < 1e300 ? 2097152.0 / extent : 0.0;
  std::vector<Entry> entries(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i] + Vec3{0.0, 0.0, 0.0};  // -0.0 becomes 0.0
    entries[i] = {spread_bits(quantize(p.x, low.x, scale)) << 2 |
                      spread_bits(quantize(p.y, low.y, scale)) << 1 |
                      spread_bits(quantize(p.z, low.z, scale)),
                  p, static_cast<std::uint32_t>(i)};
  }
  std::sort(entries.begin(), entries.end(), before);
  return entries;
}

}  // namespace

SpatialOrder sort_spatially(std::span<const Vec3> points) {
  SpatialOrder order;
  order.points.reserve(points.size());
  order.order_of_point.resize(points.size());
  for (const Entry& entry : sorted_entries(points)) {
    if (order.points.empty() || !(order.points.back() == entry.point)) {
      order.points.push_back(entry.point);
    }
    order.order_of_point[entry.index] = static_cast<std::uint32_t>(order.points.size() - 1);
  }
  return order;
}

}  // namespace morsel
