// Source: T. K. Dey, J. Giesen, S. Goswami, "Shape Segmentation and Matching from Noisy Point
// Clouds", SPBG 2004, section 2.

#include <algorithm>
#include <cmath>
#include <morsel/error.hpp>
#include <morsel/interior.hpp>
#include <numbers>
#include <string>
#include <utility>

#include "base/bucket_sort.hpp"
#include "base/threads.hpp"
#include "base/union_find.hpp"
#include "delaunay/balls.hpp"
#include "interior/openings.hpp"
#include "interior/poles.hpp"

namespace morsel {
namespace {

// A walk through balls that meet deeply, from the unbounded ones; marks what it reaches as outer.
// `may_enter(cell)` says whether a ball is big enough.
template <typename MayEnter>
void walk_from_outside(const DelaunayComplex& complex, double min_cosine, const MayEnter& may_enter,
                       std::vector<CellSide>& side) {
  std::vector<std::uint32_t> stack;
  const auto enter = [&](std::uint32_t cell) {
    side[cell] = CellSide::kOuter;
    stack.push_back(cell);
  };
  in_turn(complex.cells.size(), [&](std::size_t cell) {
    const auto c = static_cast<std::uint32_t>(cell);
    for (int i = 0; i < 4 && side[c] == CellSide::kOpen; ++i) {
      if (complex.neighbors[c][i] == kNoCell && may_enter(c) &&
          cos_hull_angle(complex, c, i) > min_cosine) {
        enter(c);
      }
    }
  });
  for (std::size_t turn = 0; !stack.empty(); ++turn) {
    if (turn % 65536 == 0) check_cancelled();
    const std::uint32_t c = stack.back();
    stack.pop_back();
    for (const std::uint32_t d : complex.neighbors[c]) {
      if (d != kNoCell && side[d] == CellSide::kOpen && may_enter(d) &&
          cos_ball_angle(complex, c, d) > min_cosine) {
        enter(d);
      }
    }
  }
}

std::vector<CellSide> label_as_published(const DelaunayComplex& complex,
                                         const std::vector<double>& lambda,
                                         const InteriorOptions& options) {
  std::vector<CellSide> side(complex.cell_count(), CellSide::kOpen);
  const auto is_big = [&](std::uint32_t cell) {
    return std::ranges::any_of(complex.cells[cell], [&](std::uint32_t v) {
      return complex.radii[cell] > options.big_ball_ratio * lambda[v];
    });
  };
  walk_from_outside(complex, std::cos(options.deep_angle * std::numbers::pi / 180.0), is_big, side);
  for (std::uint32_t c = 0; c < side.size(); ++c) {
    if (side[c] == CellSide::kOpen && is_big(c)) side[c] = CellSide::kInner;
  }
  return side;
}

// A connection between two adjacent cells over which a label may flow.
struct Bridge {
  double strength;
  std::uint32_t a;
  std::uint32_t b;

  // Strongest first; equal strengths by index, for the same result in every run.
  friend bool operator<(const Bridge& x, const Bridge& y) {
    if (x.strength != y.strength) return x.strength > y.strength;
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  }
};

// Joins two trees unless they already carry different labels; the label sits at the root.
void join_labels(UnionFind& forest, std::vector<CellSide>& side, std::uint32_t a, std::uint32_t b) {
  a = forest.root(a);
  b = forest.root(b);
  if (a == b) return;
  if (side[a] != CellSide::kOpen && side[b] != CellSide::kOpen && side[a] != side[b]) return;
  const CellSide label = side[a] != CellSide::kOpen ? side[a] : side[b];
  forest.join(a, b);
  side[forest.root(a)] = label;
}

std::vector<double> ball_ratios(const DelaunayComplex& complex, const std::vector<double>& lambda,
                                int threads) {
  std::vector<double> ratio(complex.cell_count());
  parallel_ranges(ratio.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const auto& [i, j, k, l] = complex.cells[c];
      ratio[c] = complex.radii[c] / std::max({lambda[i], lambda[j], lambda[k], lambda[l]});
    }
  });
  return ratio;
}

// Between all neighbours of which one at least is still open.
std::vector<Bridge> find_bridges(const DelaunayComplex& complex, const std::vector<double>& ratio,
                                 const std::vector<CellSide>& side, int threads) {
  const auto collect = [&](std::size_t begin, std::size_t end, std::vector<Bridge>& bridges) {
    for (auto c = static_cast<std::uint32_t>(begin); c < end; ++c) {
      for (const std::uint32_t d : complex.neighbors[c]) {
        if (d == kNoCell || d < c) continue;
        if (side[c] != CellSide::kOpen && side[d] != CellSide::kOpen) continue;
        const double depth = 1.0 + cos_ball_angle(complex, c, d);
        bridges.push_back({std::min(ratio[c], ratio[d]) * depth, c, d});
      }
    }
  };
  return parallel_collect<Bridge>(side.size(), threads, collect);
}

// What an open cell is joined to for being opposite a seed: stands for all cells of that label.
struct Shores {
  std::uint32_t outer;
  std::uint32_t inner;
};

// A point of a surface has the inside on one face and the outside on the other. Where the largest
// ball of a vertex is a seed, or unbounded, the largest one opposite is of the other kind, however
// thin the wall: there it is too small to be a seed by itself.
std::vector<Bridge> find_walls(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                               const std::vector<double>& ratio, const std::vector<CellSide>& side,
                               const Shores& shores, int threads) {
  // Balls between points that fill space, not a surface, are about as large as their spacing.
  constexpr double kWallRatio = 1.25;
  const std::vector<Vec3> normals = hull_normals(complex);
  const auto any = [](std::uint32_t) { return true; };
  const auto visit = [&](std::uint32_t v, std::vector<Bridge>& walls) {
    Vec3 direction = normals[v];
    CellSide seed = CellSide::kOuter;
    if (!(squared_norm(direction) > 0.0)) {
      const std::uint32_t pole = largest_ball(complex, vertex_cells, v, any);
      if (pole == kNoCell || side[pole] == CellSide::kOpen) return;
      direction = way_to_center(complex, v, pole);
      seed = side[pole];
    }
    const std::uint32_t c = largest_opposite_ball(complex, vertex_cells, v, direction, any);
    if (c == kNoCell || side[c] != CellSide::kOpen || ratio[c] < kWallRatio) return;
    const double depth = 1.0 - cosine(way_to_center(complex, v, c), direction);
    walls.push_back({ratio[c] * depth, c, seed == CellSide::kOuter ? shores.inner : shores.outer});
  };
  const auto collect = [&](std::size_t begin, std::size_t end, std::vector<Bridge>& walls) {
    for (std::size_t v = begin; v < end; ++v) visit(static_cast<std::uint32_t>(v), walls);
  };
  return parallel_collect<Bridge>(normals.size(), threads, collect);
}

// Flooding from the seeds, strongest bridge first, first come first served, is growing a maximum
// spanning forest with one kind of seed a tree; so the bridges are sorted once and joined.
void flood(const DelaunayComplex& complex, const VertexCells& vertex_cells,
           const std::vector<double>& ratio, std::vector<CellSide>& side, int threads) {
  const auto cells = static_cast<std::uint32_t>(side.size());
  const Shores shores{.outer = cells, .inner = cells + 1};
  std::vector<Bridge> bridges = find_bridges(complex, ratio, side, threads);
  const auto walls = find_walls(complex, vertex_cells, ratio, side, shores, threads);
  bridges.insert(bridges.end(), walls.begin(), walls.end());
  bucket_sort(bridges, kSizeBuckets, threads,
              [](const Bridge& bridge) { return size_bucket(bridge.strength); });
  side.insert(side.end(), {CellSide::kOuter, CellSide::kInner});
  UnionFind forest(side.size());
  in_turn(bridges.size(),
          [&](std::size_t i) { join_labels(forest, side, bridges[i].a, bridges[i].b); });
  in_turn(side.size(),
          [&](std::size_t c) { side[c] = side[forest.root(static_cast<std::uint32_t>(c))]; });
  side.resize(cells);
}

// Inner cells in groups so much smaller than the largest that they are gaps in the noise band, not
// objects, are outside after all.
void drop_flecks(const DelaunayComplex& complex, std::vector<CellSide>& side) {
  constexpr double kSmallestObject = 0.02;
  UnionFind groups(side.size());
  const auto inner = [&](std::uint32_t c) { return side[c] == CellSide::kInner; };
  in_turn(side.size(), [&](std::size_t cell) {
    const auto c = static_cast<std::uint32_t>(cell);
    for (const std::uint32_t d : complex.neighbors[c]) {
      if (d != kNoCell && d > c && inner(c) && inner(d)) groups.join(c, d);
    }
  });
  std::vector<std::uint32_t> size(side.size(), 0);
  std::uint32_t largest = 0;
  for (std::uint32_t c = 0; c < side.size(); ++c) {
    if (inner(c)) largest = std::max(largest, ++size[groups.root(c)]);
  }
  for (std::uint32_t c = 0; c < side.size(); ++c) {
    if (inner(c) && size[groups.root(c)] < kSmallestObject * largest) side[c] = CellSide::kOuter;
  }
}

Interior label_by_flood(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                        const std::vector<double>& lambda, int threads) {
  // A ball this many times larger than its corners' spacing cannot come from noise or sampling.
  constexpr double kSeedRatio = 4.0;
  constexpr double kSeedCosine = 0.5;  // 60 degrees
  Interior interior;
  interior.side.assign(complex.cell_count(), CellSide::kOpen);
  const std::vector<double> ratio = ball_ratios(complex, lambda, threads);
  const auto is_seed = [&](std::uint32_t cell) { return ratio[cell] > kSeedRatio; };
  walk_from_outside(complex, kSeedCosine, is_seed, interior.side);
  for (std::uint32_t c = 0; c < interior.side.size(); ++c) {
    if (interior.side[c] == CellSide::kOpen && is_seed(c)) interior.side[c] = CellSide::kInner;
  }
  const Closing closing =
      close_openings(complex, vertex_cells, lambda, kSeedCosine, interior.side, threads);
  interior.bare_share = closing.bare_share;
  flood(complex, vertex_cells, ratio, interior.side, threads);
  drop_flecks(complex, interior.side);
  Openings openings = find_openings(complex, lambda, interior.side, closing.leaked, threads);
  interior.openings = std::move(openings.list);
  interior.open_share = openings.share;
  return interior;
}

}  // namespace

void InteriorOptions::check() const {
  if (!(big_ball_ratio > 0.0)) {
    throw Error(ErrorCode::kUsage,
                "big_ball_ratio is " + std::to_string(big_ball_ratio) + "; it must be above 0");
  }
  if (!(deep_angle >= 0.0 && deep_angle <= 180.0)) {
    throw Error(ErrorCode::kUsage,
                "deep_angle is " + std::to_string(deep_angle) + "; it must be 0 to 180 degrees");
  }
}

Interior find_interior(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                       const std::vector<double>& lambda, const InteriorOptions& options,
                       int threads) {
  options.check();
  Interior interior;
  if (options.method == Method::kPaper) {
    interior.side = label_as_published(complex, lambda, options);
  } else {
    interior = label_by_flood(complex, vertex_cells, lambda, threads);
  }
  for (std::size_t c = 0; c < interior.side.size(); ++c) {
    interior.outer_cells += interior.side[c] == CellSide::kOuter ? 1 : 0;
    if (interior.side[c] != CellSide::kInner) continue;
    ++interior.inner_cells;
    interior.volume += cell_volume(complex, c);
  }
  return interior;
}

}  // namespace morsel
