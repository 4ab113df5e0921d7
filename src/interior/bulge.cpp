#include "interior/bulge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/cancel.hpp"
#include "delaunay/balls.hpp"

namespace morsel {
namespace {

// A sample that lies higher, as a share of how far it is from its vertex, is of another sheet.
constexpr double kSteep = 0.5;

// A triangle that bounds the inside. From its k-th corner a point lies slope[k + 1] · (point −
// corner) along one of the edges there and slope[k + 2] · … along the other.
struct Triangle {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t cell;  // behind it
  double area;
  Vec3 normal;  // out of the inside
  std::array<Vec3, 3> slope;
};

Triangle make_triangle(const DelaunayComplex& complex, std::uint32_t cell, int slot) {
  Triangle triangle{};
  triangle.cell = cell;
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.corners[k] = complex.cells[cell][kFacetSlots[slot][k]];
  }
  const Facet facet = facet_of(complex, cell, slot);
  const Vec3 n = normal_of(facet);
  const double twice_area = norm(n);
  triangle.area = 0.5 * twice_area;
  triangle.normal = (1.0 / twice_area) * n;
  const auto slope_across = [&](const Vec3& opposite) {
    return (1.0 / twice_area) * cross(triangle.normal, opposite);
  };
  triangle.slope = {slope_across(facet.c - facet.b), slope_across(facet.a - facet.c),
                    slope_across(facet.b - facet.a)};
  return triangle;
}

std::vector<Triangle> find_surface(const DelaunayComplex& complex,
                                   const std::vector<CellSide>& side) {
  std::vector<Triangle> surface;
  in_turn(complex.cell_count(), [&](std::size_t c) {
    if (side[c] != CellSide::kInner) return;
    for (int slot = 0; slot < 4; ++slot) {
      const std::uint32_t d = complex.neighbors[c][slot];
      if (d != kNoCell && side[d] == CellSide::kInner) continue;
      surface.push_back(make_triangle(complex, static_cast<std::uint32_t>(c), slot));
    }
  });
  return surface;
}

// The triangles at each vertex.
struct Fans {
  std::vector<std::uint32_t> begins;     // (v + 1)
  std::vector<std::uint32_t> triangles;  // places in the surface

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t vertex) const {
    return std::span(triangles).subspan(begins[vertex], begins[vertex + 1] - begins[vertex]);
  }
};

Fans find_fans(std::size_t vertices, const std::vector<Triangle>& surface) {
  Fans fans;
  fans.begins.assign(vertices + 1, 0);
  for (const Triangle& triangle : surface) {
    for (const std::uint32_t v : triangle.corners) ++fans.begins[v + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) fans.begins[v + 1] += fans.begins[v];
  fans.triangles.resize(fans.begins.back());
  std::vector<std::uint32_t> ends(fans.begins.begin(), fans.begins.end() - 1);
  for (std::uint32_t t = 0; t < surface.size(); ++t) {
    for (const std::uint32_t v : surface[t].corners) fans.triangles[ends[v]++] = t;
  }
  return fans;
}

// Of a place `arm` away from the vertex, above the triangle there that it lies above most clearly.
double height_of(const Vec3& arm, std::uint32_t vertex, std::span<const std::uint32_t> fan,
                 const std::vector<Triangle>& surface) {
  double clearest = -std::numeric_limits<double>::infinity();
  double height = 0.0;
  for (const std::uint32_t t : fan) {
    const Triangle& triangle = surface[t];
    const std::size_t k = triangle.corners[1] == vertex ? 1 : triangle.corners[2] == vertex ? 2 : 0;
    const double within =
        std::min(dot(triangle.slope[(k + 1) % 3], arm), dot(triangle.slope[(k + 2) % 3], arm));
    if (!(within > clearest)) continue;
    clearest = within;
    height = dot(triangle.normal, arm);
  }
  return height;
}

// (v) Means of the samples at each vertex.
std::vector<double> mean_heights(const DelaunayComplex& complex,
                                 const std::vector<Triangle>& surface,
                                 const SurfaceSamples& samples) {
  const std::size_t count = complex.vertices.size();
  const Fans fans = find_fans(count, surface);
  std::vector<double> sum(count, 0.0);
  std::vector<double> counted(count, 0.0);
  in_turn(samples.points.size(), [&](std::size_t i) {
    const std::uint32_t v = samples.vertex[i];
    const Vec3 arm = samples.points[i] - complex.vertices[v];
    const double height = height_of(arm, v, fans.of(v), surface);
    if (!(std::abs(height) <= kSteep * norm(arm))) return;
    sum[v] += height;
    counted[v] += 1.0;
  });
  for (std::size_t v = 0; v < count; ++v) sum[v] /= std::max(counted[v], 1.0);
  return sum;
}

}  // namespace

std::vector<double> find_bulges(const DelaunayComplex& complex, const std::vector<CellSide>& side,
                                const SurfaceSamples& samples) {
  const std::vector<Triangle> surface = find_surface(complex, side);
  const std::vector<double> height = mean_heights(complex, surface, samples);
  std::vector<double> bulges(complex.cell_count(), 0.0);
  for (const Triangle& triangle : surface) {
    const auto& [a, b, c] = triangle.corners;
    bulges[triangle.cell] += triangle.area * (height[a] + height[b] + height[c]) / 3.0;
  }
  return bulges;
}

}  // namespace morsel
