#include "segment/point_labels.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "base/threads.hpp"

namespace morsel {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

// The maximum of each basin.
struct Maximum {
  Vec3 center;
  double squared_radius;
};

std::vector<Maximum> maxima_of(const DelaunayComplex& complex, const Basins& basins) {
  std::vector<Maximum> maxima;
  maxima.reserve(basins.count());
  for (const std::uint32_t cell : basins.maximum) {
    maxima.push_back({complex.centers[cell], complex.radii[cell] * complex.radii[cell]});
  }
  return maxima;
}

// Squared (|p - c| / R) with ties to the smaller basin.
struct BestBall {
  double squared_ratio = kInfinity;
  std::uint32_t basin = kNoBasin;

  void offer(const std::vector<Maximum>& maxima, const Vec3& p, std::uint32_t candidate) {
    const Maximum& maximum = maxima[candidate];
    const double ratio = squared_distance(p, maximum.center) / maximum.squared_radius;
    if (ratio < squared_ratio || (ratio == squared_ratio && candidate < basin)) {
      squared_ratio = ratio;
      basin = candidate;
    }
  }
};

// Vertices without an inner cell take their basin over the shortest edges first, so that no label
// jumps along the long edges of the hull; ties by index.
void spread_labels(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                   std::vector<std::uint32_t>& basin_of_vertex) {
  using Edge = std::pair<double, std::uint32_t>;  // squared length, basin beyond it
  using Offer = std::tuple<double, std::uint32_t, std::uint32_t>;  // the same, the vertex between
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> offers;
  std::vector<Edge> best(basin_of_vertex.size(), Edge{kInfinity, kNoBasin});
  const auto edge = [&](std::uint32_t from, std::uint32_t to) {
    return Edge{squared_distance(complex.vertices[from], complex.vertices[to]),
                basin_of_vertex[from]};
  };
  const auto offer_best = [&](std::uint32_t v) {
    offers.emplace(best[v].first, v, best[v].second);
  };
  // Few vertices have no label, so they look for those that have one.
  for (std::uint32_t v = 0; v < basin_of_vertex.size(); ++v) {
    if (basin_of_vertex[v] != kNoBasin) continue;
    for (const std::uint32_t c : vertex_cells.of(v)) {
      for (const std::uint32_t w : complex.cells[c]) {
        if (basin_of_vertex[w] != kNoBasin) best[v] = std::min(best[v], edge(w, v));
      }
    }
    if (best[v].second != kNoBasin) offer_best(v);
  }
  while (!offers.empty()) {
    const std::uint32_t v = std::get<1>(offers.top());
    offers.pop();
    if (basin_of_vertex[v] != kNoBasin) continue;
    basin_of_vertex[v] = best[v].second;
    for (const std::uint32_t c : vertex_cells.of(v)) {
      for (const std::uint32_t w : complex.cells[c]) {
        if (basin_of_vertex[w] != kNoBasin || !(edge(v, w) < best[w])) continue;
        best[w] = edge(v, w);
        offer_best(w);
      }
    }
  }
}

}  // namespace

std::vector<std::uint32_t> label_vertices(const DelaunayComplex& complex,
                                          const VertexCells& vertex_cells, const Basins& basins,
                                          const std::vector<Neck>& necks, int threads) {
  std::vector<std::uint32_t> basin_of_vertex(complex.vertices.size(), kNoBasin);
  if (basins.count() == 0) return basin_of_vertex;
  const BasinGraph graph = make_basin_graph(basins.count(), necks);
  const std::vector<Maximum> maxima = maxima_of(complex, basins);
  parallel_ranges(basin_of_vertex.size(), threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> touched;
    for (std::size_t v = begin; v < end; ++v) {
      touched.clear();
      for (const std::uint32_t c : vertex_cells.of(v)) {
        const std::uint32_t b = basins.basin_of_cell[c];
        if (b != kNoBasin && std::ranges::find(touched, b) == touched.end()) touched.push_back(b);
      }
      BestBall best;
      for (const std::uint32_t b : touched) {
        best.offer(maxima, complex.vertices[v], b);
        for (std::uint32_t i = graph.offsets[b]; i < graph.offsets[b + 1]; ++i) {
          best.offer(maxima, complex.vertices[v], graph.targets[i]);
        }
      }
      basin_of_vertex[v] = best.basin;
    }
  });
  spread_labels(complex, vertex_cells, basin_of_vertex);
  return basin_of_vertex;
}

}  // namespace morsel
