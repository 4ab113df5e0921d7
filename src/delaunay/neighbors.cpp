#include <algorithm>
#include <array>
#include <limits>
#include <morsel/delaunay.hpp>

#include "base/threads.hpp"

namespace morsel {
namespace {

// The nearest vertices found so far, nearest first; ties go to the smaller index.
struct Nearest {
  struct Entry {
    double squared = std::numeric_limits<double>::infinity();
    std::uint32_t vertex = kNoVertex;

    friend bool operator<(const Entry& x, const Entry& y) {
      return x.squared != y.squared ? x.squared < y.squared : x.vertex < y.vertex;
    }
  };
  std::array<Entry, 3> entries;

  // Whoever is held already, or was sent away, is not taken again.
  void offer(const Entry& entry) {
    if (!(entry < entries[2]) || entry.vertex == entries[0].vertex ||
        entry.vertex == entries[1].vertex) {
      return;
    }
    entries[2] = entry;
    if (entries[2] < entries[1]) std::swap(entries[2], entries[1]);
    if (entries[1] < entries[0]) std::swap(entries[1], entries[0]);
  }
};

Nearest find_nearest_three(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                           std::uint32_t p) {
  Nearest nearest;
  const auto offer_star = [&](std::uint32_t center) {
    for (const std::uint32_t c : vertex_cells.of(center)) {
      for (const std::uint32_t v : complex.cells[c]) {
        if (v != p) nearest.offer({squared_distance(complex.vertices[p], complex.vertices[v]), v});
      }
    }
  };
  offer_star(p);
  // entries[0] is final after the own star, entries[1] after the star of entries[0], …
  for (std::size_t k = 0; k < 2; ++k) {
    const std::uint32_t vertex = nearest.entries[k].vertex;
    if (vertex != kNoVertex) offer_star(vertex);
  }
  return nearest;
}

}  // namespace

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

std::vector<double> mean_neighbor_distance(const DelaunayComplex& complex,
                                           const VertexCells& vertex_cells, int threads) {
  std::vector<double> lambda(complex.vertices.size(), 0.0);
  parallel_ranges(lambda.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double sum = 0.0;
      int count = 0;
      const Nearest nearest =
          find_nearest_three(complex, vertex_cells, static_cast<std::uint32_t>(i));
      for (const auto& entry : nearest.entries) {
        if (entry.vertex == kNoVertex) break;
        sum += std::sqrt(entry.squared);
        ++count;
      }
      if (count > 0) lambda[i] = sum / count;
    }
  });
  return lambda;
}

}  // namespace morsel
