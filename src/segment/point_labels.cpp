#include "segment/point_labels.hpp"

#include <algorithm>
#include <limits>

namespace morsel {
namespace {

// Basins that touch each basin, as one list with offsets.
struct BasinGraph {
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> targets;
};

BasinGraph make_basin_graph(std::size_t count, const std::vector<Neck>& necks) {
  BasinGraph graph;
  graph.offsets.assign(count + 1, 0);
  for (const Neck& neck : necks) {
    ++graph.offsets[neck.a + 1];
    ++graph.offsets[neck.b + 1];
  }
  for (std::size_t b = 0; b < count; ++b) graph.offsets[b + 1] += graph.offsets[b];
  graph.targets.resize(2 * necks.size());
  std::vector<std::uint32_t> ends(graph.offsets.begin(), graph.offsets.end() - 1);
  for (const Neck& neck : necks) {
    graph.targets[ends[neck.a]++] = neck.b;
    graph.targets[ends[neck.b]++] = neck.a;
  }
  return graph;
}

// Squared (|p - c| / R) with ties to the smaller basin.
struct BestBall {
  double squared_ratio = std::numeric_limits<double>::infinity();
  std::uint32_t basin = kNoBasin;

  void offer(const DelaunayComplex& complex, const Basins& basins, const Vec3& p,
             std::uint32_t candidate) {
    const std::uint32_t cell = basins.maximum[candidate];
    const double ratio =
        squared_distance(p, complex.centers[cell]) / (complex.radii[cell] * complex.radii[cell]);
    if (ratio < squared_ratio || (ratio == squared_ratio && candidate < basin)) {
      squared_ratio = ratio;
      basin = candidate;
    }
  }
};

// Gives vertices without an inner cell the basin of their nearest labelled Delaunay neighbour, in
// rounds, so that the result does not depend on the order of the vertices.
void spread_labels(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                   std::vector<std::uint32_t>& basin_of_vertex) {
  std::vector<std::uint32_t> open;
  for (std::uint32_t v = 0; v < basin_of_vertex.size(); ++v) {
    if (basin_of_vertex[v] == kNoBasin) open.push_back(v);
  }
  while (!open.empty()) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    std::vector<std::uint32_t> rest;
    for (const std::uint32_t v : open) {
      double nearest = std::numeric_limits<double>::infinity();
      std::uint32_t basin = kNoBasin;
      for (const std::uint32_t c : vertex_cells.of(v)) {
        for (const std::uint32_t w : complex.cells[c]) {
          if (basin_of_vertex[w] == kNoBasin) continue;
          const double squared = squared_distance(complex.vertices[v], complex.vertices[w]);
          if (squared < nearest) {
            nearest = squared;
            basin = basin_of_vertex[w];
          }
        }
      }
      if (basin == kNoBasin) {
        rest.push_back(v);
      } else {
        found.emplace_back(v, basin);
      }
    }
    if (found.empty()) return;
    for (const auto& [v, basin] : found) basin_of_vertex[v] = basin;
    open = std::move(rest);
  }
}

}  // namespace

std::vector<std::uint32_t> label_vertices(const DelaunayComplex& complex,
                                          const VertexCells& vertex_cells, const Basins& basins,
                                          const std::vector<Neck>& necks) {
  std::vector<std::uint32_t> basin_of_vertex(complex.vertices.size(), kNoBasin);
  if (basins.count() == 0) return basin_of_vertex;
  const BasinGraph graph = make_basin_graph(basins.count(), necks);
  std::vector<std::uint32_t> touched;
  for (std::uint32_t v = 0; v < basin_of_vertex.size(); ++v) {
    touched.clear();
    for (const std::uint32_t c : vertex_cells.of(v)) {
      const std::uint32_t b = basins.basin_of_cell[c];
      if (b != kNoBasin && std::ranges::find(touched, b) == touched.end()) touched.push_back(b);
    }
    BestBall best;
    for (const std::uint32_t b : touched) {
      best.offer(complex, basins, complex.vertices[v], b);
      for (std::uint32_t i = graph.offsets[b]; i < graph.offsets[b + 1]; ++i) {
        best.offer(complex, basins, complex.vertices[v], graph.targets[i]);
      }
    }
    basin_of_vertex[v] = best.basin;
  }
  spread_labels(complex, vertex_cells, basin_of_vertex);
  return basin_of_vertex;
}

}  // namespace morsel
