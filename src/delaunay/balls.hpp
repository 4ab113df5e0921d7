// Circumscribed balls of cells and facets.
#pragma once

#include <array>
#include <cstdint>
#include <morsel/delaunay.hpp>
#include <morsel/vec3.hpp>

namespace morsel {

/// The vertices of the facet opposite vertex i of a cell, in slots of the cell, ordered so that the
/// facet's normal (b - a) x (c - a) points out of a positively oriented cell.
inline constexpr std::array<std::array<int, 3>, 4> kFacetSlots{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Its corners in that order.
struct Facet {
  Vec3 a, b, c;
};
[[nodiscard]] inline Facet facet_of(const DelaunayComplex& complex, std::size_t cell, int slot) {
  const auto corner = [&](int k) {
    return complex.vertices[complex.cells[cell][kFacetSlots[slot][k]]];
  };
  return {corner(0), corner(1), corner(2)};
}

/// Along its outer normal, as long as twice its area.
[[nodiscard]] inline Vec3 normal_of(const Facet& facet) {
  return cross(facet.b - facet.a, facet.c - facet.a);
}
[[nodiscard]] inline double area_of(const Facet& facet) { return 0.5 * norm(normal_of(facet)); }

/// Fills centers and radii of the complex. Cells too flat for double precision are computed with
/// exact arithmetic.
void compute_balls(DelaunayComplex& complex, int threads);

/// Radius of the circle through three points; infinite when they are collinear.
[[nodiscard]] double circumradius(const Vec3& a, const Vec3& b, const Vec3& c);

/// True when `test` lies strictly inside the smallest sphere through a, b, c. Exact.
[[nodiscard]] bool inside_equatorial_sphere(const Vec3& a, const Vec3& b, const Vec3& c,
                                            const Vec3& test);

/// Cosine of the angle under which the balls of two neighbouring cells meet: the angle between the
/// directions from a shared point to the two centres. 1 for the same ball, -1 for balls touching
/// from outside. Source: Dey, Giesen, Goswami 2004, section 2.
[[nodiscard]] double cos_ball_angle(const DelaunayComplex& complex, std::size_t a, std::size_t b);

/// The same between a cell's ball and the unbounded ball beyond its facet `slot` on the hull, whose
/// centre lies at infinity along the facet's outer normal.
[[nodiscard]] double cos_hull_angle(const DelaunayComplex& complex, std::size_t cell, int slot);

}  // namespace morsel
