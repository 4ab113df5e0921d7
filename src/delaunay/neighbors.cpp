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

  // Each vertex at most once.
  void offer(const Entry& entry) {
    if (!(entry < entries[2])) return;
    entries[2] = entry;
    if (entries[2] < entries[1]) std::swap(entries[2], entries[1]);
    if (entries[1] < entries[0]) std::swap(entries[1], entries[0]);
  }
};

// Searches around one vertex after another.
class NearestSearch {
 public:
  NearestSearch(const DelaunayComplex& complex, const VertexCells& vertex_cells)
      : complex_(complex),
        vertex_cells_(vertex_cells),
        seen_from_(complex.vertices.size(), kNoVertex) {}

  Nearest search(std::uint32_t p) {
    Nearest nearest;
    seen_from_[p] = p;
    offer_star(p, p, nearest);
    // entries[0] is final after the own star, entries[1] after the star of entries[0], …
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint32_t vertex = nearest.entries[k].vertex;
      if (vertex != kNoVertex) offer_star(p, vertex, nearest);
    }
    return nearest;
  }

 private:
  void offer_star(std::uint32_t of, std::uint32_t center, Nearest& nearest) {
    for (const std::uint32_t c : vertex_cells_.of(center)) {
      for (const std::uint32_t v : complex_.cells[c]) {
        if (seen_from_[v] == of) continue;
        seen_from_[v] = of;
        nearest.offer({squared_distance(complex_.vertices[of], complex_.vertices[v]), v});
      }
    }
  }

  const DelaunayComplex& complex_;
  const VertexCells& vertex_cells_;
  std::vector<std::uint32_t> seen_from_;  // the last vertex for which each one was looked at
};

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
  for (const auto& cell : complex.cells) {
    for (const std::uint32_t v : cell) ++result.offsets[v + 2];
  }
  for (std::size_t v = 2; v < result.offsets.size(); ++v) {
    result.offsets[v] += result.offsets[v - 1];
  }
  // offsets[v + 1] now is the begin of v and becomes its end while the cells are filled in.
  result.cells.resize(4 * complex.cells.size());
  for (std::size_t c = 0; c < complex.cells.size(); ++c) {
    for (const std::uint32_t v : complex.cells[c]) {
      result.cells[result.offsets[v + 1]++] = static_cast<std::uint32_t>(c);
    }
  }
  result.offsets.pop_back();
  return result;
}

std::vector<double> mean_neighbor_distance(const DelaunayComplex& complex,
                                           const VertexCells& vertex_cells, int threads) {
  std::vector<double> lambda(complex.vertices.size(), 0.0);
  parallel_ranges(lambda.size(), threads, [&](std::size_t begin, std::size_t end) {
    NearestSearch around(complex, vertex_cells);
    for (std::size_t i = begin; i < end; ++i) {
      double sum = 0.0;
      int count = 0;
      for (const auto& entry : around.search(static_cast<std::uint32_t>(i)).entries) {
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
