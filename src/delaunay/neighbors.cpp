#include <morsel/delaunay.hpp>

#include "base/neighborhoods.hpp"
#include "base/threads.hpp"

namespace morsel {
double cell_volume(const DelaunayComplex& complex, std::size_t cell) {
  const auto& [i, j, k, l] = complex.cells[cell];
  const Vec3& p = complex.vertices[i];
  return dot(complex.vertices[j] - p, cross(complex.vertices[k] - p, complex.vertices[l] - p)) /
         6.0;
}

Vec3 cell_centroid(const DelaunayComplex& complex, std::size_t cell) {
  Vec3 sum;
  for (const std::uint32_t v : complex.cells[cell]) sum = sum + complex.vertices[v];
  return 0.25 * sum;
}

VertexCells find_vertex_cells(const DelaunayComplex& complex) {
  VertexCells result;
  result.offsets.assign(complex.vertices.size() + 2, 0);
  in_turn(complex.cells.size(), [&](std::size_t c) {
    for (const std::uint32_t v : complex.cells[c]) ++result.offsets[v + 2];
  });
  for (std::size_t v = 2; v < result.offsets.size(); ++v) {
    result.offsets[v] += result.offsets[v - 1];
  }
  // offsets[v + 1] now is the begin of v and becomes its end while the cells are filled in.
  result.cells.resize(4 * complex.cells.size());
  in_turn(complex.cells.size(), [&](std::size_t c) {
    for (const std::uint32_t v : complex.cells[c]) {
      result.cells[result.offsets[v + 1]++] = static_cast<std::uint32_t>(c);
    }
  });
  result.offsets.pop_back();
  return result;
}

std::vector<double> mean_neighbor_distance(const DelaunayComplex& complex, int threads) {
  const std::vector<Vec3>& points = complex.vertices;
  const Neighborhoods nearest = find_neighborhoods(points, 3, threads);
  std::vector<double> lambda(points.size(), 0.0);
  if (nearest.size == 0) return lambda;
  const auto measure = [&](std::size_t i) {
    ThreeLeast least;
    for (const std::uint32_t j : nearest.of(i)) least.add(distance(points[i], points[j]));
    lambda[i] = least.mean();
  };
  parallel_ranges(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) measure(i);
  });
  return lambda;
}

}  // namespace morsel
