#include "segment/sight.hpp"

#include <algorithm>
#include <cmath>

#include "base/threads.hpp"
#include "delaunay/balls.hpp"

namespace morsel {
namespace {

// Root mean square radii of the object at which a pair's weight has fallen to 1/e.
constexpr double kSightScale = 0.4;
// Pairs farther apart, of weights below exp(-1.5²) = 0.1, are not looked at.
constexpr double kSightReach = 1.5 * kSightScale;

// A straight walk from cell to cell.
class SegmentWalk {
 public:
  SegmentWalk(const DelaunayComplex& complex, const Interior& interior)
      : complex_(complex), interior_(interior) {}

  // True when the segment between the centroids of two cells leaves the inside for at most
  // `tolerance` units in all.
  [[nodiscard]] bool stays_inside(std::uint32_t from, std::uint32_t to, double tolerance) const {
    const Vec3 start = cell_centroid(complex_, from);
    const Vec3 direction = cell_centroid(complex_, to) - start;
    double allowed = tolerance / norm(direction);
    double entered = 0.0;
    std::uint32_t cell = from;
    std::uint32_t previous = kNoCell;
    while (cell != to) {
      const Exit exit = find_exit(cell, previous, start, direction);
      if (exit.slot < 0) return true;  // rounding hid the way out, next to the end
      const double left = std::clamp(exit.at, entered, 1.0);
      if (interior_.side[cell] != CellSide::kInner) allowed -= left - entered;
      if (allowed < 0.0) return false;
      if (exit.at >= 1.0) return true;
      entered = left;
      previous = cell;
      cell = complex_.neighbors[cell][exit.slot];
      if (cell == kNoCell) return false;
    }
    return true;
  }

 private:
  struct Exit {
    int slot = -1;
    double at = 2.0;  // as a share of the segment
  };

  [[nodiscard]] Exit find_exit(std::uint32_t cell, std::uint32_t previous, const Vec3& start,
                               const Vec3& direction) const {
    Exit exit;
    const auto& corners = complex_.cells[cell];
    for (int i = 0; i < 4; ++i) {
      if (previous != kNoCell && complex_.neighbors[cell][i] == previous) continue;
      const Vec3& a = complex_.vertices[corners[kFacetSlots[i][0]]];
      const Vec3& b = complex_.vertices[corners[kFacetSlots[i][1]]];
      const Vec3& c = complex_.vertices[corners[kFacetSlots[i][2]]];
      const Vec3 normal = cross(b - a, c - a);
      const double speed = dot(normal, direction);
      if (speed <= 0.0) continue;
      const double at = dot(normal, a - start) / speed;
      if (at < exit.at) exit = {i, at};
    }
    return exit;
  }

  const DelaunayComplex& complex_;
  const Interior& interior_;
};

}  // namespace

SightTable find_sight(const DelaunayComplex& complex, const Interior& interior,
                      const Pieces& pieces, double spacing, int threads) {
  const std::size_t count = pieces.count();
  SightTable table;
  table.seen.assign(count * count, 0.0F);
  table.weight.assign(count * count, 0.0F);
  const SegmentWalk walk(complex, interior);
  parallel_rows(count, threads, [&](std::size_t a) {
    for (std::size_t b = 0; b < a; ++b) {
      const std::uint32_t from = pieces.seed[a];
      const std::uint32_t to = pieces.seed[b];
      const double apart = distance(cell_centroid(complex, from), cell_centroid(complex, to));
      const double relative = apart / pieces.extent[a];
      if (!(relative < kSightReach)) continue;
      const double scaled = relative / kSightScale;
      table.seen[a * count + b] = table.seen[b * count + a] =
          walk.stays_inside(from, to, 0.5 * spacing) ? 1.0F : 0.0F;
      table.weight[a * count + b] = table.weight[b * count + a] =
          static_cast<float>(std::exp(-scaled * scaled));
    }
    table.seen[a * count + a] = table.weight[a * count + a] = 1.0F;
  });
  return table;
}

}  // namespace morsel
