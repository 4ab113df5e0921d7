// Source: T. K. Dey, J. Giesen, S. Goswami, "Shape Segmentation and Matching from Noisy Point
// Clouds", SPBG 2004, section 3.3.

#include <algorithm>
#include <cmath>
#include <limits>
#include <morsel/segment.hpp>
#include <numeric>
#include <tuple>

#include "base/union_find.hpp"
#include "delaunay/balls.hpp"
#include "segment/point_labels.hpp"

namespace morsel {
namespace {

// A basin or group of basins with a smaller share of its object's points is no part of its own.
constexpr double kSmallestShare = 0.005;

std::vector<Neck> find_necks(const DelaunayComplex& complex, const Basins& basins) {
  std::vector<Neck> necks;
  for (std::uint32_t c = 0; c < complex.cells.size(); ++c) {
    const std::uint32_t b = basins.basin_of_cell[c];
    if (b == kNoBasin) continue;
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t d = complex.neighbors[c][i];
      if (d == kNoCell || basins.basin_of_cell[d] == kNoBasin || basins.basin_of_cell[d] <= b) {
        continue;
      }
      const auto& cell = complex.cells[c];
      const auto& slots = kFacetSlots[i];
      necks.push_back({b, basins.basin_of_cell[d],
                       circumradius(complex.vertices[cell[slots[0]]], complex.vertices[cell[slots[1]]],
                                    complex.vertices[cell[slots[2]]])});
    }
  }
  std::ranges::sort(necks, [](const Neck& x, const Neck& y) {
    return std::tie(x.a, x.b, y.radius) < std::tie(y.a, y.b, x.radius);
  });
  const auto repeated = std::ranges::unique(
      necks, [](const Neck& x, const Neck& y) { return x.a == y.a && x.b == y.b; });
  necks.erase(repeated.begin(), repeated.end());
  return necks;
}

// Moments of a tetrahedron with vertices p0 … p3 about the origin: ∫ x xᵀ = V/20 (Σ p pᵀ + s sᵀ)
// with s = Σ p.
Moments cell_moments(const DelaunayComplex& complex, std::uint32_t cell, const Vec3& origin) {
  Moments moments;
  moments.volume = cell_volume(complex, cell);
  Vec3 sum;
  for (const std::uint32_t v : complex.cells[cell]) sum = sum + (complex.vertices[v] - origin);
  moments.first = (0.25 * moments.volume) * sum;
  const auto add = [&](const Vec3& p) {
    const double w = moments.volume / 20.0;
    moments.second[0] += w * p.x * p.x;
    moments.second[1] += w * p.x * p.y;
    moments.second[2] += w * p.x * p.z;
    moments.second[3] += w * p.y * p.y;
    moments.second[4] += w * p.y * p.z;
    moments.second[5] += w * p.z * p.z;
  };
  add(sum);
  for (const std::uint32_t v : complex.cells[cell]) add(complex.vertices[v] - origin);
  return moments;
}

void sum_basins(const DelaunayComplex& complex, const Basins& basins, MergeTree& tree) {
  tree.origin = complex.vertices.empty() ? Vec3{} : complex.vertices.front();
  tree.moments.resize(basins.count());
  for (std::uint32_t c = 0; c < complex.cells.size(); ++c) {
    const std::uint32_t b = basins.basin_of_cell[c];
    if (b != kNoBasin) tree.moments[b] += cell_moments(complex, c, tree.origin);
  }
  for (const std::uint32_t maximum : basins.maximum) {
    tree.ball_center.push_back(complex.centers[maximum]);
    tree.ball_radius.push_back(complex.radii[maximum]);
  }
}

// Single linkage: the minimum spanning forest of the basins over the merge ratios.
std::vector<Merge> link(const std::vector<Neck>& necks, const std::vector<double>& ball_radius,
                        double spacing) {
  std::vector<Merge> candidates;
  static const double tol = getenv("TOL") ? atof(getenv("TOL")) : 0.25;
  candidates.reserve(necks.size());
  for (const Neck& neck : necks) {
    const double larger = std::max(ball_radius[neck.a], ball_radius[neck.b]);
    // Sampling moves both radii by up to half the spacing.
    static const double alp = getenv("ALP") ? atof(getenv("ALP")) : 0.0;
    const double ratio = (std::sqrt(std::max(larger * larger - alp * spacing * spacing, 0.0)) - tol * spacing) / (neck.radius + tol * spacing);
    candidates.push_back({std::max(ratio, 1.0), neck.a, neck.b, false});
  }
  std::ranges::stable_sort(candidates, {}, &Merge::ratio);
  UnionFind groups(ball_radius.size());
  std::vector<Merge> merges;
  for (const Merge& merge : candidates) {
    if (groups.join(merge.a, merge.b)) merges.push_back(merge);
  }
  return merges;
}

void mark_significant(MergeTree& tree) {
  const auto objects = [&] {
    UnionFind all(tree.point_count.size());
    for (const Merge& merge : tree.merges) all.join(merge.a, merge.b);
    return all;
  };
  UnionFind object = objects();
  std::vector<std::size_t> object_points(tree.point_count.size(), 0);
  for (std::uint32_t b = 0; b < tree.point_count.size(); ++b) {
    object_points[object.root(b)] += tree.point_count[b];
    tree.component_count += object.root(b) == b ? 1 : 0;
  }
  UnionFind groups(tree.point_count.size());
  std::vector<std::size_t> points(tree.point_count.begin(), tree.point_count.end());
  for (Merge& merge : tree.merges) {
    const std::size_t a = points[groups.root(merge.a)];
    const std::size_t b = points[groups.root(merge.b)];
    const double needed =
        kSmallestShare * static_cast<double>(object_points[object.root(merge.a)]);
    merge.significant = static_cast<double>(std::min(a, b)) >= needed;
    groups.join(merge.a, merge.b);
    points[groups.root(merge.a)] = a + b;
  }
}

}  // namespace

Moments& Moments::operator+=(const Moments& other) {
  volume += other.volume;
  first = first + other.first;
  for (std::size_t i = 0; i < second.size(); ++i) second[i] += other.second[i];
  return *this;
}

MergeTree build_merge_tree(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                           const std::vector<double>& lambda, const Basins& basins,
                           const MergeOptions& options) {
  MergeTree tree;
  tree.necks = find_necks(complex, basins);
  sum_basins(complex, basins, tree);
  const double spacing = lambda.empty() ? 0.0
                                        : std::accumulate(lambda.begin(), lambda.end(), 0.0) /
                                              static_cast<double>(lambda.size());
  tree.merges = link(tree.necks, tree.ball_radius,
                     options.method == Method::kPaper ? 0.0 : spacing);
  const std::vector<std::uint32_t> basin_of_vertex =
      label_vertices(complex, vertex_cells, basins, tree.necks);
  tree.point_count.assign(basins.count(), 0);
  tree.basin_of_point.reserve(complex.vertex_of_point.size());
  for (const std::uint32_t v : complex.vertex_of_point) {
    tree.basin_of_point.push_back(basin_of_vertex[v]);
    if (basin_of_vertex[v] != kNoBasin) ++tree.point_count[basin_of_vertex[v]];
  }
  mark_significant(tree);
  return tree;
}

}  // namespace morsel
