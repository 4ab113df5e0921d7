#include "segment/sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/threads.hpp"
#include "delaunay/balls.hpp"

namespace morsel {
namespace {

// Root mean square radii of the object at which a pair's weight has fallen to 1/e.
constexpr double kSightScale = 0.4;
// Pairs farther apart, of weights below exp(-1.5²) = 0.1, are not looked at.
constexpr double kSightReach = 1.5 * kSightScale;

// A straight walk from cell to cell. Each corner is seen from the start along the way: x and y
// across it, z along it, 1 at the end. The way leaves a cell through the facet whose image holds
// the origin.
class SegmentWalk {
 public:
  SegmentWalk(const DelaunayComplex& complex, const Interior& interior)
      : complex_(complex), interior_(interior) {}

  // True when the segment between the centroids `start` and `end` of two cells leaves the inside
  // for at most `tolerance` units in all.
  [[nodiscard]] bool stays_inside(std::uint32_t from, std::uint32_t to, const Vec3& start,
                                  const Vec3& end, double tolerance) const {
    const View view(start, end);
    double allowed = tolerance / view.length();
    double entered = 0.0;  // as shares of the segment, kept up to date outside only
    std::uint32_t cell = from;
    Facet facet = first_facet(view, from);
    // A straight walk meets no cell twice; where cells are flat, rounding may turn it in a circle
    // (R. P. Brent's test finds any within twice its length). Nothing outside was met on it.
    std::uint32_t milestone = kNoCell;
    std::size_t step = 0;
    std::size_t next_milestone = 64;
    while (cell != to) {
      if (cell == milestone) return true;
      if (++step == next_milestone) {
        milestone = cell;
        next_milestone *= 2;
      }
      const bool inner = interior_.side[cell] == CellSide::kInner;
      const std::uint32_t next = complex_.neighbors[cell][facet.slot];
      if (next == kNoCell) return false;
      if (!inner) {
        const double left = std::clamp(height(facet), entered, 1.0);
        allowed -= left - entered;
        if (allowed < 0.0) return false;
        entered = left;
      } else if (interior_.side[next] != CellSide::kInner) {
        entered = std::clamp(height(facet), 0.0, 1.0);
      }
      if (facet.corners[0].z >= 1.0 && facet.corners[1].z >= 1.0 && facet.corners[2].z >= 1.0) {
        return true;  // rounding hid the last cell
      }
      advance(view, cell, next, facet);
      cell = next;
    }
    return true;
  }

 private:
  class View {
   public:
    View(const Vec3& start, const Vec3& end) : start_(start) {
      const Vec3 way = end - start;
      length_ = norm(way);
      const Vec3 along = (1.0 / length_) * way;
      // Any axis across will do; that of the smallest component is far from parallel.
      const Vec3 size{std::abs(along.x), std::abs(along.y), std::abs(along.z)};
      const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3{1.0, 0.0, 0.0}
                        : size.y <= size.z                   ? Vec3{0.0, 1.0, 0.0}
                                                             : Vec3{0.0, 0.0, 1.0};
      const Vec3 across = cross(along, axis);
      x_ = (1.0 / norm(across)) * across;
      y_ = cross(along, x_);
      z_ = (1.0 / length_) * along;
      // Off the axis by next to nothing, so that regular samples have no corner exactly on it.
      constexpr double kNextToNothing = 1e-9;
      start_ = start_ + kNextToNothing * length_ * (x_ + 0.6180339887 * y_);
    }
    [[nodiscard]] double length() const { return length_; }
    [[nodiscard]] Vec3 see(const Vec3& p) const {
      const Vec3 d = p - start_;
      return {dot(x_, d), dot(y_, d), dot(z_, d)};
    }

   private:
    Vec3 start_;
    double length_ = 0.0;
    Vec3 x_, y_, z_;
  };

  // The way out of a cell: counter-clockwise as seen by the eye of the walk.
  struct Facet {
    std::array<Vec3, 3> corners;
    std::array<std::uint32_t, 3> vertices;
    std::size_t slot;  // opposite it, in the cell that is left
  };

  // Without a branch: which one it is cannot be foreseen.
  static std::size_t slot_of(const std::array<std::uint32_t, 4>& four, std::uint32_t value) {
    return static_cast<std::size_t>(four[1] == value) +
           2 * static_cast<std::size_t>(four[2] == value) +
           3 * static_cast<std::size_t>(four[3] == value);
  }

  // Twice the signed area of the origin and two corners.
  static double turn(const Vec3& a, const Vec3& b) { return a.x * b.y - a.y * b.x; }

  // Where the segment meets the facet.
  static double height(const Facet& facet) {
    const auto& [a, b, c] = facet.corners;
    const double wa = turn(b, c);
    const double wb = turn(c, a);
    const double wc = turn(a, b);
    const double sum = wa + wb + wc;
    return sum > 0.0 ? (wa * a.z + wb * b.z + wc * c.z) / sum : a.z;
  }

  // The facet of the first cell whose image holds the origin most clearly.
  [[nodiscard]] Facet first_facet(const View& view, std::uint32_t cell) const {
    Facet best{};
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t slot = 0; slot < 4; ++slot) {
      Facet facet{};
      facet.slot = slot;
      for (std::size_t k = 0; k < 3; ++k) {
        facet.vertices[k] = complex_.cells[cell][static_cast<std::size_t>(kFacetSlots[slot][k])];
        facet.corners[k] = view.see(complex_.vertices[facet.vertices[k]]);
      }
      const auto& [a, b, c] = facet.corners;
      const double least = std::min({turn(a, b), turn(b, c), turn(c, a)});
      if (least <= most) continue;
      most = least;
      best = facet;
    }
    return best;
  }

  // From the facet between `previous` and `cell` to the one through which `cell` is left: the new
  // corner takes the place of the one that it hides.
  void advance(const View& view, std::uint32_t previous, std::uint32_t cell, Facet& facet) const {
    const auto& vertices = complex_.cells[cell];
    const std::uint32_t vertex = vertices[slot_of(complex_.neighbors[cell], previous)];
    const Vec3 corner = view.see(complex_.vertices[vertex]);
    // Which corners lie to the left of the ray from the origin through the new one.
    unsigned left = 0;
    for (unsigned k = 0; k < 3; ++k) {
      left |= static_cast<unsigned>(turn(corner, facet.corners[k]) >= 0.0) << k;
    }
    // The ray is met again between a left one and a right one; the third corner is hidden.
    constexpr std::array<std::uint8_t, 8> kHidden{0, 2, 0, 0, 1, 2, 1, 0};
    const std::size_t hidden = kHidden[left];
    facet.slot = slot_of(vertices, facet.vertices[hidden]);
    facet.corners[hidden] = corner;
    facet.vertices[hidden] = vertex;
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
  std::vector<Vec3> place;
  for (const std::uint32_t cell : pieces.seed) place.push_back(cell_centroid(complex, cell));
  parallel_rows(count, threads, [&](std::size_t a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double relative = distance(place[a], place[b]) / pieces.extent[a];
      if (!(relative < kSightReach)) continue;
      const double scaled = relative / kSightScale;
      table.seen[a * count + b] = table.seen[b * count + a] =
          walk.stays_inside(pieces.seed[a], pieces.seed[b], place[a], place[b], 0.5 * spacing)
              ? 1.0F
              : 0.0F;
      table.weight[a * count + b] = table.weight[b * count + a] =
          static_cast<float>(std::exp(-scaled * scaled));
    }
    table.seen[a * count + a] = table.weight[a * count + a] = 1.0F;
  });
  return table;
}

}  // namespace morsel
