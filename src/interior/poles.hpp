// The largest balls that touch a vertex: what lies on the two faces of the surface there.
#pragma once

#include <cstdint>
#include <morsel/delaunay.hpp>
#include <morsel/vec3.hpp>
#include <vector>

namespace morsel {

/// Sum of the normals of the hull's facets around each vertex; zero within. Cost: O(v + c).
[[nodiscard]] std::vector<Vec3> hull_normals(const DelaunayComplex& complex);

/// From the vertex to the centre of the cell's ball.
[[nodiscard]] inline Vec3 way_to_center(const DelaunayComplex& complex, std::uint32_t vertex,
                                        std::uint32_t cell) {
  return complex.centers[cell] - complex.vertices[vertex];
}

/// Cosine of the angle between two directions.
[[nodiscard]] inline double cosine(const Vec3& a, const Vec3& b) {
  return dot(a, b) / (norm(a) * norm(b));
}

/// Of the cells that meet at the vertex and that `may(cell)` accepts, the one with the largest
/// ball; the first of equal ones, kNoCell if there is none.
template <typename May>
[[nodiscard]] std::uint32_t largest_ball(const DelaunayComplex& complex,
                                         const VertexCells& vertex_cells, std::uint32_t vertex,
                                         const May& may) {
  std::uint32_t best = kNoCell;
  double largest = 0.0;
  for (const std::uint32_t c : vertex_cells.of(vertex)) {
    if (complex.radii[c] <= largest || !may(c)) continue;
    largest = complex.radii[c];
    best = c;
  }
  return best;
}

/// The same of the cells whose centres lie opposite `direction`: at 120 degrees or more from it.
template <typename May>
[[nodiscard]] std::uint32_t largest_opposite_ball(const DelaunayComplex& complex,
                                                  const VertexCells& vertex_cells,
                                                  std::uint32_t vertex, const Vec3& direction,
                                                  const May& may) {
  constexpr double kOpposite = -0.5;
  return largest_ball(complex, vertex_cells, vertex, [&](std::uint32_t c) {
    return may(c) && cosine(way_to_center(complex, vertex, c), direction) <= kOpposite;
  });
}

}  // namespace morsel
