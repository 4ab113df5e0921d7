#include "interior/openings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/threads.hpp"
#include "base/union_find.hpp"
#include "delaunay/balls.hpp"
#include "interior/poles.hpp"

namespace morsel {
namespace {

// The surface around a pocket is larger than its opening by this factor: a half sphere, whose is
// larger by two, is no pocket.
constexpr double kWallsPerOpening = 3.0;
// Smaller shares of the surface are not worth a pocket, nor a look for one.
constexpr double kSmallestPocket = 0.01;
constexpr int kMostPockets = 8;
constexpr double kSmallestOpening = 2.0;  // radius over spacing; below, chance gaps of the sampling
// Smaller areas than these are chance bridges across creases: of the widest opening's where a leak
// says that there is one, else of the inside's surface.
constexpr double kNotableBesideWidest = 0.06;
constexpr double kNotableShare = 0.03;
constexpr double kWideFacet = 6.0;  // longest edge over spacing
// λ² is this share of the area that each of uniformly random points on a plane stands for.
constexpr double kAreaPerSquaredLambda = 1.88;

constexpr std::uint32_t kNone = kNoCell;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Where the way between two neighbouring cells' centres is narrowest: the least radius of the
// largest empty ball along it. Infinite from a cell to the one that its ball grows into.
struct Passage {
  double radius;
  std::uint32_t a;
  std::uint32_t b;  // a cell, or the number of cells: the unbounded outside

  friend bool operator<(const Passage& x, const Passage& y) {
    if (x.radius != y.radius) return x.radius > y.radius;
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  }
};

// Beyond the facet, as seen from the cell.
bool is_beyond(const Facet& facet, const Vec3& point) {
  return dot(normal_of(facet), point - facet.a) > 0.0;
}

// Through which facet an outer cell's ball grows: that beyond which its centre lies, towards the
// largest ball if there are two; -1 for a maximum.
int way_up(const DelaunayComplex& complex, const std::vector<CellSide>& side, std::uint32_t c) {
  int best = -1;
  double largest = 0.0;
  for (int i = 0; i < 4; ++i) {
    const std::uint32_t d = complex.neighbors[c][i];
    if (d != kNoCell && side[d] != CellSide::kOuter) continue;
    const double radius = d == kNoCell ? kInfinity : complex.radii[d];
    if (radius <= largest || !is_beyond(facet_of(complex, c, i), complex.centers[c])) continue;
    largest = radius;
    best = i;
  }
  return best;
}

// Between the outer cells and the unbounded outside, where the walk from outside may go: the balls
// meet at an angle of a cosine above `min_cosine`.
std::vector<Passage> find_passages(const DelaunayComplex& complex,
                                   const std::vector<CellSide>& side, double min_cosine,
                                   int threads) {
  std::vector<Passage> passages;
  const auto unbounded = static_cast<std::uint32_t>(complex.cell_count());
  in_turn(unbounded, [&](std::size_t cell) {
    const auto c = static_cast<std::uint32_t>(cell);
    if (side[c] != CellSide::kOuter) return;
    const int up = way_up(complex, side, c);
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t d = complex.neighbors[c][i];
      if (i == up) {
        passages.push_back({kInfinity, c, d == kNoCell ? unbounded : d});
        continue;
      }
      if (d != kNoCell && (d < c || side[d] != CellSide::kOuter)) continue;
      const double cosine =
          d == kNoCell ? cos_hull_angle(complex, c, i) : cos_ball_angle(complex, c, d);
      if (!(cosine > min_cosine)) continue;
      const Facet facet = facet_of(complex, c, i);
      const bool here = !is_beyond(facet, complex.centers[c]);
      const bool there = d == kNoCell || is_beyond(facet, complex.centers[d]);
      double radius =
          d == kNoCell ? complex.radii[c] : std::min(complex.radii[c], complex.radii[d]);
      if (here && there) radius = circumradius(facet.a, facet.b, facet.c);
      passages.push_back({radius, c, d == kNoCell ? unbounded : d});
    }
  });
  parallel_sort(passages, threads);
  return passages;
}

// Whether an inner cell touches each vertex.
std::vector<char> find_backed(const VertexCells& vertex_cells, const std::vector<CellSide>& side,
                              std::size_t vertices, int threads) {
  std::vector<char> backed(vertices, 0);
  const auto inner = [&](std::uint32_t c) { return side[c] == CellSide::kInner; };
  parallel_ranges(vertices, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      backed[v] = std::ranges::any_of(vertex_cells.of(v), inner) ? 1 : 0;
    }
  });
  return backed;
}

// The largest outer balls that touch a vertex from its two sides.
struct Poles {
  std::uint32_t first = kNone;   // an outer cell, or the number of cells: the unbounded outside
  std::uint32_t second = kNone;  // another on the opposite side, if no inner cell touches it
};

// Of the vertex v; `normal` is that of the hull there, zero within it.
Poles poles_of(const DelaunayComplex& complex, const VertexCells& vertex_cells,
               const std::vector<CellSide>& side, std::uint32_t v, const Vec3& normal,
               bool backed) {
  const auto outer = [&](std::uint32_t c) { return side[c] == CellSide::kOuter; };
  Poles poles;
  Vec3 direction = normal;
  if (squared_norm(normal) > 0.0) {
    poles.first = static_cast<std::uint32_t>(complex.cell_count());
  } else {
    poles.first = largest_ball(complex, vertex_cells, v, outer);
    if (poles.first == kNone) return poles;
    direction = way_to_center(complex, v, poles.first);
  }
  if (!backed) poles.second = largest_opposite_ball(complex, vertex_cells, v, direction, outer);
  return poles;
}

std::vector<Poles> find_poles(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                              const std::vector<CellSide>& side, const std::vector<char>& backed,
                              int threads) {
  const std::vector<Vec3> normals = hull_normals(complex);
  std::vector<Poles> poles(complex.vertices.size());
  parallel_ranges(poles.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      poles[v] = poles_of(complex, vertex_cells, side, static_cast<std::uint32_t>(v), normals[v],
                          backed[v] != 0);
    }
  });
  return poles;
}

// Sets of outer cells, joined widest passage first, with the surface that each would gain or lose
// if it were inside.
class Pockets {
 public:
  Pockets(const std::vector<Poles>& poles, const std::vector<char>& backed,
          const std::vector<double>& area, std::size_t cells)
      : poles_(poles), area_(area), sets_(cells + 1), gain_(cells + 1, 0.0), samples_(cells + 1) {
    for (std::uint32_t v = 0; v < poles.size(); ++v) {
      const Poles& pole = poles[v];
      if (pole.first == kNone) continue;
      if (backed[v] != 0) gain_[pole.first] -= area[v];
      if (pole.second == kNone) continue;
      for (const std::uint32_t c : {pole.first, pole.second}) {
        gain_[c] += area[v];
        samples_[c].push_back(v);
      }
    }
  }

  std::uint32_t root(std::uint32_t cell) { return sets_.root(cell); }
  [[nodiscard]] double gain(std::uint32_t root) const { return gain_[root]; }

  void join(std::uint32_t a, std::uint32_t b) {
    if (samples_[a].size() < samples_[b].size()) std::swap(a, b);
    double gain = gain_[a] + gain_[b];
    for (const std::uint32_t v : samples_[b]) {
      const std::uint32_t first = root(poles_[v].first);
      const std::uint32_t second = root(poles_[v].second);
      // Both faces belong to one set from now on.
      if ((first == a && second == b) || (first == b && second == a)) gain -= 2.0 * area_[v];
    }
    std::vector<std::uint32_t> samples = std::move(samples_[a]);
    samples.insert(samples.end(), samples_[b].begin(), samples_[b].end());
    samples_[b] = {};
    sets_.join(a, b);
    const std::uint32_t joined = root(a);
    gain_[joined] = gain;
    samples_[joined] = std::move(samples);
  }

 private:
  const std::vector<Poles>& poles_;
  const std::vector<double>& area_;
  UnionFind sets_;
  std::vector<double> gain_;
  std::vector<std::vector<std::uint32_t>> samples_;
};

struct Pocket {
  double value = 0.0;          // surface gained beyond what the opening takes, an area
  std::uint32_t cell = kNone;  // one of its cells
};

// The pocket that is worth most.
Pocket find_pocket(const std::vector<Passage>& passages, std::uint32_t unbounded,
                   const std::vector<Poles>& poles, const std::vector<char>& backed,
                   const std::vector<double>& area) {
  Pockets pockets(poles, backed, area, unbounded);
  Pocket best;
  in_turn(passages.size(), [&](std::size_t i) {
    const Passage& passage = passages[i];
    const std::uint32_t a = pockets.root(passage.a);
    const std::uint32_t b = pockets.root(passage.b);
    if (a == b) return;
    const std::uint32_t outside = pockets.root(unbounded);
    const double cost = kWallsPerOpening * std::numbers::pi * passage.radius * passage.radius;
    for (const auto& [set, cell] : {std::pair{a, passage.a}, std::pair{b, passage.b}}) {
      const double value = pockets.gain(set) - cost;
      if (set != outside && value > best.value) best = {value, cell};
    }
    pockets.join(a, b);
  });
  return best;
}

// Labels the pocket inner, and of the other outer cells those that it reaches by wider passages
// than the unbounded outside does. Leaves the passages that are still outside.
void fill_pocket(std::vector<Passage>& passages, const Pocket& pocket,
                 std::vector<CellSide>& side) {
  const auto unbounded = static_cast<std::uint32_t>(side.size());
  UnionFind sets(side.size() + 1);
  in_turn(passages.size(), [&](std::size_t i) {
    const std::uint32_t a = sets.root(passages[i].a);
    const std::uint32_t b = sets.root(passages[i].b);
    const std::uint32_t inside = sets.root(pocket.cell);
    const std::uint32_t outside = sets.root(unbounded);
    if ((a == inside && b == outside) || (a == outside && b == inside)) return;
    sets.join(a, b);
  });
  for (std::uint32_t c = 0; c < side.size(); ++c) {
    if (side[c] == CellSide::kOuter && sets.root(c) == sets.root(pocket.cell)) {
      side[c] = CellSide::kInner;
    }
  }
  const auto filled = [&](std::uint32_t c) {
    return c != unbounded && side[c] == CellSide::kInner;
  };
  std::erase_if(passages, [&](const Passage& p) { return filled(p.a) || filled(p.b); });
}

// A facet between inside and outside that is too wide for the sampling there.
struct WideFacet {
  double area;
  double spacing;
  Vec3 center;
  std::array<std::uint32_t, 3> corners;
};

// Appends what visit(cell, slot, values) finds at the facets of the inside's surface, in the order
// of cells.
template <typename Value, typename Visit>
std::vector<Value> visit_walls(const DelaunayComplex& complex, const std::vector<CellSide>& side,
                               int threads, const Visit& visit) {
  const auto inner = [&](std::uint32_t c) { return c != kNoCell && side[c] == CellSide::kInner; };
  return parallel_collect<Value>(
      side.size(), threads, [&](std::size_t begin, std::size_t end, std::vector<Value>& values) {
        for (auto c = static_cast<std::uint32_t>(begin); c < end; ++c) {
          for (int i = 0; inner(c) && i < 4; ++i) {
            if (!inner(complex.neighbors[c][i])) visit(c, i, values);
          }
        }
      });
}

std::vector<WideFacet> find_wide_facets(const DelaunayComplex& complex,
                                        const std::vector<double>& lambda,
                                        const std::vector<CellSide>& side, int threads) {
  const auto visit = [&](std::uint32_t c, int i, std::vector<WideFacet>& found) {
    const Facet facet = facet_of(complex, c, i);
    WideFacet wide{};
    for (std::size_t k = 0; k < 3; ++k) wide.corners[k] = complex.cells[c][kFacetSlots[i][k]];
    for (const std::uint32_t v : wide.corners) wide.spacing = std::max(wide.spacing, lambda[v]);
    const double longest =
        std::max({squared_distance(facet.a, facet.b), squared_distance(facet.b, facet.c),
                  squared_distance(facet.c, facet.a)});
    const double most = kWideFacet * wide.spacing;
    if (longest <= most * most) return;
    wide.area = area_of(facet);
    wide.center = (1.0 / 3.0) * (facet.a + facet.b + facet.c);
    found.push_back(wide);
  };
  return visit_walls<WideFacet>(complex, side, threads, visit);
}

double surface_area(const DelaunayComplex& complex, const std::vector<CellSide>& side,
                    int threads) {
  const auto visit = [&](std::uint32_t c, int i, std::vector<double>& areas) {
    areas.push_back(area_of(facet_of(complex, c, i)));
  };
  const auto areas = visit_walls<double>(complex, side, threads, visit);
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

}  // namespace

Closing close_openings(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                       const std::vector<double>& lambda, double min_cosine,
                       std::vector<CellSide>& side, int threads) {
  const auto unbounded = static_cast<std::uint32_t>(side.size());
  std::vector<double> area(lambda.size());
  std::ranges::transform(lambda, area.begin(),
                         [](double l) { return kAreaPerSquaredLambda * l * l; });
  const double total = std::accumulate(area.begin(), area.end(), 0.0);
  std::vector<Passage> passages;
  for (int round = 0;; ++round) {
    const std::vector<char> backed = find_backed(vertex_cells, side, area.size(), threads);
    double bare = 0.0;  // at most
    for (std::size_t v = 0; v < area.size(); ++v) bare += backed[v] != 0 ? 0.0 : area[v];
    const bool leaked = round > 0;
    if (bare < kSmallestPocket * total) return {leaked, 0.0};
    const auto poles = find_poles(complex, vertex_cells, side, backed, threads);
    bare = 0.0;
    for (std::size_t v = 0; v < area.size(); ++v) bare += poles[v].second != kNone ? area[v] : 0.0;
    const Closing closing{leaked, bare / total};
    if (bare < kSmallestPocket * total || round == kMostPockets) return closing;
    if (!leaked) passages = find_passages(complex, side, min_cosine, threads);
    const Pocket pocket = find_pocket(passages, unbounded, poles, backed, area);
    if (pocket.value < kSmallestPocket * total) return closing;
    fill_pocket(passages, pocket, side);
  }
}

Openings find_openings(const DelaunayComplex& complex, const std::vector<double>& lambda,
                       const std::vector<CellSide>& side, bool leaked, int threads) {
  Openings openings;
  const std::vector<WideFacet> facets = find_wide_facets(complex, lambda, side, threads);
  if (facets.empty()) return openings;
  UnionFind rims(complex.vertices.size());  // wide facets with a common corner close one opening
  for (const WideFacet& facet : facets) {
    rims.join(facet.corners[0], facet.corners[1]);
    rims.join(facet.corners[0], facet.corners[2]);
  }
  struct Sum {
    double area = 0.0;
    Vec3 moment;
    double spacing = 0.0;
  };
  std::map<std::uint32_t, Sum> sums;
  for (const WideFacet& facet : facets) {
    Sum& sum = sums[rims.root(facet.corners[0])];
    sum.area += facet.area;
    sum.moment = sum.moment + facet.area * facet.center;
    sum.spacing = std::max(sum.spacing, facet.spacing);
  }
  const double surface = surface_area(complex, side, threads);
  double largest = 0.0;
  for (const auto& [rim, sum] : sums) largest = std::max(largest, sum.area);
  const double least = leaked ? kNotableBesideWidest * largest : kNotableShare * surface;
  for (const auto& [rim, sum] : sums) {
    const double radius = std::sqrt(sum.area / std::numbers::pi);
    if (sum.area < least || radius < kSmallestOpening * sum.spacing) continue;
    openings.list.push_back({(1.0 / sum.area) * sum.moment, radius});
    openings.share += sum.area / surface;
  }
  std::ranges::stable_sort(openings.list, std::greater<>(), &Opening::radius);
  return openings;
}

}  // namespace morsel
