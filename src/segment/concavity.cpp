#include "segment/concavity.hpp"

#include <algorithm>
#include <cmath>

#include "base/threads.hpp"
#include "interior/poles.hpp"

namespace morsel {
namespace {

// Whether a facet of the cell that holds the vertex has nothing beyond it.
bool touches_hull(const DelaunayComplex& complex, std::uint32_t cell, std::uint32_t vertex) {
  for (std::size_t i = 0; i < 4; ++i) {
    if (complex.neighbors[cell][i] == kNoCell && complex.cells[cell][i] != vertex) return true;
  }
  return false;
}

double concavity_of(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                    const Interior& interior, std::uint32_t vertex) {
  for (const std::uint32_t c : vertex_cells.of(vertex)) {
    if (touches_hull(complex, c, vertex)) return 0.0;
  }
  const auto largest_radius = [&](bool inner) {
    const std::uint32_t c = largest_ball(complex, vertex_cells, vertex, [&](std::uint32_t other) {
      return (interior.side[other] == CellSide::kInner) == inner;
    });
    return c == kNoCell ? 0.0 : complex.radii[c];
  };
  const double inner = largest_radius(true);
  if (!(inner > 0.0)) return 0.0;
  return std::min(std::log1p(inner / largest_radius(false)),
                  kMostConcave);  // also if none is outer
}

// A crease is one for all samples near its bottom, a slit between two layers of a scan only for
// those of the layer below.
double least_around(const DelaunayComplex& complex, const VertexCells& vertex_cells, double lambda,
                    std::uint32_t vertex, const std::vector<double>& own) {
  constexpr double kNear = 1.5;
  const double squared_reach = kNear * kNear * lambda * lambda;
  double least = own[vertex];
  for (const std::uint32_t c : vertex_cells.of(vertex)) {
    for (const std::uint32_t w : complex.cells[c]) {
      const double squared = squared_distance(complex.vertices[vertex], complex.vertices[w]);
      if (squared <= squared_reach) least = std::min(least, own[w]);
    }
  }
  return least;
}

}  // namespace

std::vector<double> vertex_concavity(const DelaunayComplex& complex,
                                     const VertexCells& vertex_cells, const Interior& interior,
                                     const std::vector<double>& lambda, int threads) {
  std::vector<double> own(complex.vertices.size());
  parallel_ranges(own.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      own[v] = concavity_of(complex, vertex_cells, interior, static_cast<std::uint32_t>(v));
    }
  });
  std::vector<double> least(own);
  parallel_ranges(own.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      least[v] = least_around(complex, vertex_cells, lambda[v], static_cast<std::uint32_t>(v), own);
    }
  });
  return least;
}

}  // namespace morsel
