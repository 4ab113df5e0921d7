#include "ground/contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/box.hpp"
#include "base/neighborhoods.hpp"
#include "base/quantile.hpp"
#include "base/random.hpp"
#include "base/union_find.hpp"
#include "ground/plane.hpp"

namespace morsel {
namespace {

constexpr std::size_t kNeighbors = 12;
constexpr double kSlab = 2.0;        // height above the plane that draws outlines, over the spacing
constexpr double kLow = 0.3;         // height that the spacing is measured in, over the extent
constexpr std::size_t kFewest = 12;  // points of an outline; fewer are crumbs
constexpr std::uint32_t kPerCell = 4;  // points of a surface in a square of the spacing

// Squares of the plane around the points of interest. Three are free all around: one to grow into,
// one to shrink from and the rim.
class Grid {
 public:
  Grid(const GroundPlane& plane, std::span<const Vec3> points, double cell, std::size_t most_cells)
      : plane_(plane), axes_(plane_axes(plane)), cell_(cell) {
    Box box;
    for (const Vec3& p : points) box.add(flat(p));
    const double width = box.high.x - box.low.x;
    const double height = box.high.y - box.low.y;
    cell_ = std::max(cell_, std::sqrt(width * height / static_cast<double>(most_cells)));
    low_ = box.low - Vec3{3.0 * cell_, 3.0 * cell_, 0.0};
    columns_ = static_cast<std::size_t>(width / cell_) + 7;
    rows_ = static_cast<std::size_t>(height / cell_) + 7;
  }

  [[nodiscard]] std::size_t size() const { return columns_ * rows_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] bool is_rim(std::size_t cell) const {
    const std::size_t column = cell % columns_;
    const std::size_t row = cell / columns_;
    return column == 0 || row == 0 || column + 1 == columns_ || row + 1 == rows_;
  }
  // size() for a point beside the grid.
  [[nodiscard]] std::size_t cell_of(const Vec3& p) const {
    const Vec3 at = (1.0 / cell_) * (flat(p) - low_);
    if (!(at.x >= 0.0 && at.y >= 0.0)) return size();
    if (at.x >= static_cast<double>(columns_) || at.y >= static_cast<double>(rows_)) return size();
    return static_cast<std::size_t>(at.y) * columns_ + static_cast<std::size_t>(at.x);
  }
  // At (x, y) in [0, 1)² of the cell, on the plane.
  [[nodiscard]] Vec3 point_in(std::size_t cell, double x, double y) const {
    const double along_u = low_.x + cell_ * (static_cast<double>(cell % columns_) + x);
    const double along_v = low_.y + cell_ * (static_cast<double>(cell / columns_) + y);
    return along_u * axes_[0] + along_v * axes_[1] + plane_.offset * plane_.normal;
  }

 private:
  [[nodiscard]] Vec3 flat(const Vec3& p) const { return {dot(axes_[0], p), dot(axes_[1], p), 0.0}; }

  const GroundPlane& plane_;
  std::array<Vec3, 2> axes_;
  double cell_;
  Vec3 low_;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
};

using Mask = std::vector<char>;  // (cells)

// The cells with one of `value` among them and their eight neighbours; those at the rim stay.
Mask grown(const Grid& grid, const Mask& mask, char value) {
  Mask result = mask;
  const auto columns = static_cast<std::ptrdiff_t>(grid.columns());
  for (std::size_t c = 0; c < mask.size(); ++c) {
    if (mask[c] != value || grid.is_rim(c)) continue;
    for (const std::ptrdiff_t row : {-columns, std::ptrdiff_t{0}, columns}) {
      for (std::ptrdiff_t column = -1; column <= 1; ++column) {
        result[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(c) + row + column)] = value;
      }
    }
  }
  return result;
}

// What the rim's free cells do not reach from side to side.
Mask filled(const Grid& grid, const Mask& walls) {
  Mask inside(walls.size(), 1);
  std::vector<std::size_t> stack{0};
  inside[0] = 0;
  while (!stack.empty()) {
    const std::size_t c = stack.back();
    stack.pop_back();
    const std::size_t columns = grid.columns();
    std::vector<std::size_t> next;
    if (c % columns > 0) next.push_back(c - 1);
    if (c % columns + 1 < columns) next.push_back(c + 1);
    if (c >= columns) next.push_back(c - columns);
    if (c + columns < walls.size()) next.push_back(c + columns);
    for (const std::size_t d : next) {
      if (inside[d] == 0 || walls[d] != 0) continue;
      inside[d] = 0;
      stack.push_back(d);
    }
  }
  return inside;
}

// Frees the connected groups of cells with too few points of outlines.
void drop_crumbs(const Grid& grid, const std::vector<std::uint32_t>& outline_points, Mask& mask) {
  UnionFind groups(mask.size());
  const std::size_t columns = grid.columns();
  for (std::size_t c = 0; c < mask.size(); ++c) {
    if (mask[c] == 0 || grid.is_rim(c)) continue;
    for (const std::size_t d : {c + 1, c + columns - 1, c + columns, c + columns + 1}) {
      if (mask[d] != 0) groups.join(static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(d));
    }
  }
  std::vector<std::size_t> points(mask.size(), 0);
  for (std::uint32_t c = 0; c < mask.size(); ++c) points[groups.root(c)] += outline_points[c];
  for (std::uint32_t c = 0; c < mask.size(); ++c) {
    if (points[groups.root(c)] < kFewest) mask[c] = 0;
  }
}

// The median distance to the twelfth neighbour near the plane; 0 if there is too little.
double spacing_near(std::span<const Vec3> points, const GroundPlane& plane, int threads) {
  double tallest = 0.0;
  for (const Vec3& p : points) tallest = std::max(tallest, plane.height(p));
  std::vector<Vec3> low;
  for (const Vec3& p : points) {
    const double height = plane.height(p);
    if (height > plane.thickness && height <= plane.thickness + kLow * tallest) low.push_back(p);
  }
  if (low.size() <= kNeighbors) return 0.0;
  return quantile(find_neighborhoods(low, kNeighbors, threads).reach, 0.5);
}

// What stands on the plane, cell by cell.
struct Feet {
  Mask near;  // a cell around the feet as well
  Mask feet;
};

Feet find_feet(const Grid& grid, const std::vector<Vec3>& outline) {
  std::vector<std::uint32_t> outline_points(grid.size(), 0);
  Mask walls(grid.size(), 0);
  for (const Vec3& p : outline) {
    ++outline_points[grid.cell_of(p)];
    walls[grid.cell_of(p)] = 1;
  }
  Feet feet;
  feet.near = filled(grid, grown(grid, walls, 1));
  drop_crumbs(grid, outline_points, feet.near);
  feet.feet = grown(grid, feet.near, 0);
  return feet;
}

// Takes the points of outlines that are crumbs from the objects, and gives them those of the plane
// under their feet; returns how many in each cell.
std::vector<std::uint32_t> hand_over(std::span<const Vec3> points, const GroundPlane& plane,
                                     double top, const Grid& grid, const Feet& feet,
                                     std::vector<char>& apart) {
  std::vector<std::uint32_t> held(grid.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double height = plane.height(points[i]);
    if (height > top || height < -plane.thickness) continue;
    const std::size_t cell = grid.cell_of(points[i]);
    if (height > plane.thickness) {
      apart[i] = feet.near[cell] == 0 ? 1 : 0;
    } else if (cell < grid.size() && feet.feet[cell] != 0) {
      apart[i] = 0;
      ++held[cell];
    }
  }
  return held;
}

// As many points as a surface has, where fewer are held.
std::vector<Vec3> fill_up(const Grid& grid, const Mask& feet,
                          const std::vector<std::uint32_t>& held) {
  std::vector<Vec3> points;
  Random random(1);
  for (std::size_t c = 0; c < grid.size(); ++c) {
    for (std::uint32_t k = feet[c] != 0 ? held[c] : kPerCell; k < kPerCell; ++k) {
      const double x = random.uniform();
      points.push_back(grid.point_in(c, x, random.uniform()));
    }
  }
  return points;
}

}  // namespace

Contact find_contact(std::span<const Vec3> points, const GroundPlane& plane, int threads) {
  constexpr std::size_t kManyCells = 1000000;
  const double spacing = spacing_near(points, plane, threads);
  const double top = plane.thickness + kSlab * spacing;
  Contact contact;
  std::vector<Vec3> outline;
  for (const Vec3& p : points) {
    const double height = plane.height(p);
    contact.apart.push_back(height <= plane.thickness ? 1 : 0);
    if (height > plane.thickness && height <= top) outline.push_back(p);
  }
  if (outline.empty()) return contact;
  const Grid grid(plane, outline, spacing, std::max(kManyCells, points.size()));
  const Feet feet = find_feet(grid, outline);
  contact.base = fill_up(grid, feet.feet, hand_over(points, plane, top, grid, feet, contact.apart));
  return contact;
}

}  // namespace morsel
