// Source: T. K. Dey, J. Giesen, S. Goswami, "Shape Segmentation and Matching from Noisy Point
// Clouds", SPBG 2004, section 3.3.

#include <algorithm>
#include <cmath>
#include <map>
#include <morsel/segment.hpp>
#include <numbers>
#include <numeric>
#include <tuple>

#include "base/threads.hpp"
#include "base/union_find.hpp"
#include "delaunay/balls.hpp"
#include "segment/agglomerate.hpp"
#include "segment/concavity.hpp"
#include "segment/pieces.hpp"
#include "segment/point_labels.hpp"
#include "segment/rank.hpp"
#include "segment/sight.hpp"

namespace morsel {
namespace {

// Sampling moves the radii of maxima and necks by up to this share of the spacing.
constexpr double kRadiusTolerance = 0.25;

// Pairs of touching pieces, or of touching basins, by the label of each cell.
std::vector<Neck> find_necks(const DelaunayComplex& complex,
                             const std::vector<std::uint32_t>& label, int threads) {
  const auto collect = [&](std::size_t begin, std::size_t end, std::vector<Neck>& necks) {
    for (std::size_t c = begin; c < end; ++c) {
      const std::uint32_t b = label[c];
      if (b == kNoBasin) continue;
      for (int i = 0; i < 4; ++i) {
        const std::uint32_t d = complex.neighbors[c][i];
        if (d == kNoCell || label[d] == kNoBasin || label[d] <= b) continue;
        const Facet facet = facet_of(complex, c, i);
        necks.push_back({b, label[d], circumradius(facet.a, facet.b, facet.c)});
      }
    }
  };
  std::vector<Neck> necks = parallel_collect<Neck>(label.size(), threads, collect);
  std::ranges::sort(necks, [](const Neck& x, const Neck& y) {
    return std::tie(x.a, x.b, y.radius) < std::tie(y.a, y.b, x.radius);
  });
  const auto repeated = std::ranges::unique(
      necks, [](const Neck& x, const Neck& y) { return x.a == y.a && x.b == y.b; });
  necks.erase(repeated.begin(), repeated.end());
  return necks;
}

double merge_ratio(const DelaunayComplex& complex, const Basins& basins, const Neck& neck,
                   double tolerance) {
  const double larger =
      std::max(complex.radii[basins.maximum[neck.a]], complex.radii[basins.maximum[neck.b]]);
  return std::max((larger - tolerance) / (neck.radius + tolerance), 1.0);
}

void add_square(double weight, const Vec3& p, Moments& moments) {
  moments.second[0] += weight * p.x * p.x;
  moments.second[1] += weight * p.x * p.y;
  moments.second[2] += weight * p.x * p.z;
  moments.second[3] += weight * p.y * p.y;
  moments.second[4] += weight * p.y * p.z;
  moments.second[5] += weight * p.z * p.z;
}

// Moments of a point mass.
Moments point_moments(double volume, const Vec3& p) {
  Moments moments;
  moments.volume = volume;
  moments.first = volume * p;
  add_square(volume, p, moments);
  return moments;
}

// Moments of a tetrahedron with vertices p0 … p3 about the origin: ∫ x xᵀ = V/20 (Σ p pᵀ + s sᵀ)
// with s = Σ p.
Moments cell_moments(const DelaunayComplex& complex, std::uint32_t cell, const Vec3& origin) {
  Moments moments;
  moments.volume = cell_volume(complex, cell);
  Vec3 sum;
  for (const std::uint32_t v : complex.cells[cell]) sum = sum + (complex.vertices[v] - origin);
  moments.first = (0.25 * moments.volume) * sum;
  const double weight = moments.volume / 20.0;
  add_square(weight, sum, moments);
  for (const std::uint32_t v : complex.cells[cell]) {
    add_square(weight, complex.vertices[v] - origin, moments);
  }
  return moments;
}

void sum_pieces(const DelaunayComplex& complex, const Interior& interior,
                const std::vector<std::uint32_t>& piece_of_cell, std::size_t count,
                MergeTree& tree) {
  tree.origin = complex.vertices.empty() ? Vec3{} : complex.vertices.front();
  tree.moments.resize(count);
  tree.ball_center.resize(count);
  tree.ball_radius.assign(count, 0.0);
  in_turn(complex.cells.size(), [&](std::size_t cell) {
    const auto c = static_cast<std::uint32_t>(cell);
    const std::uint32_t p = piece_of_cell[c];
    if (p == kNoBasin) return;
    tree.moments[p] += cell_moments(complex, c, tree.origin);
    if (!interior.bulges.empty() && interior.bulges[c] != 0.0) {
      // As if it lay where the cell does.
      const Vec3 place = cell_centroid(complex, c) - tree.origin;
      tree.moments[p] += point_moments(interior.bulges[c], place);
    }
    if (complex.radii[c] > tree.ball_radius[p]) {
      tree.ball_radius[p] = complex.radii[c];
      tree.ball_center[p] = complex.centers[c];
    }
  });
}

// Merge ratios of touching basins, single linkage: the minimum spanning forest. Sampling moves
// both radii by up to `tolerance`.
std::vector<Merge> link(const DelaunayComplex& complex, const Basins& basins,
                        const std::vector<Neck>& necks, double tolerance) {
  std::vector<Merge> candidates;
  candidates.reserve(necks.size());
  for (const Neck& neck : necks) {
    candidates.push_back({merge_ratio(complex, basins, neck, tolerance), neck.a, neck.b, false});
  }
  std::ranges::stable_sort(candidates, {}, &Merge::ratio);
  UnionFind groups(basins.count());
  std::vector<Merge> merges;
  for (const Merge& merge : candidates) {
    if (groups.join(merge.a, merge.b)) merges.push_back(merge);
  }
  return merges;
}

std::vector<std::uint32_t> count_points(const DelaunayComplex& complex,
                                        const std::vector<std::uint32_t>& label_of_vertex,
                                        std::size_t count) {
  std::vector<std::uint32_t> points(count, 0);
  for (const std::uint32_t v : complex.vertex_of_point) {
    if (v != kNoVertex && label_of_vertex[v] != kNoBasin) ++points[label_of_vertex[v]];
  }
  return points;
}

// What the default method knows of the basins before it cuts them into pieces.
struct BasinGroups {
  std::vector<Neck> necks;
  std::vector<std::uint32_t> basin_of_vertex;
  std::vector<std::uint32_t> region_of_basin;  // basins that no neck separates
  std::vector<std::uint32_t> object_of_basin;  // basins that touch at all
};

std::vector<std::uint32_t> group_labels(UnionFind& groups, std::size_t count) {
  std::vector<std::uint32_t> label_of_root(count, kNoBasin);
  std::vector<std::uint32_t> labels(count);
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint32_t& label = label_of_root[groups.root(i)];
    if (label == kNoBasin) label = next++;
    labels[i] = label;
  }
  return labels;
}

BasinGroups group_basins(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                         const Basins& basins, double spacing, int threads) {
  // Radii of one region differ by so much from sampling alone.
  constexpr double kSameRegion = 1.03;
  BasinGroups result;
  result.necks = find_necks(complex, basins.basin_of_cell, threads);
  result.basin_of_vertex = label_vertices(complex, vertex_cells, basins, result.necks, threads);
  std::vector<Merge> merges = link(complex, basins, result.necks, kRadiusTolerance * spacing);
  mark_significant(count_points(complex, result.basin_of_vertex, basins.count()), merges);
  UnionFind regions(basins.count());
  UnionFind objects(basins.count());
  for (const Merge& merge : merges) {
    objects.join(merge.a, merge.b);
    if (!merge.significant || merge.ratio <= kSameRegion) regions.join(merge.a, merge.b);
  }
  result.region_of_basin = group_labels(regions, basins.count());
  result.object_of_basin = group_labels(objects, basins.count());
  return result;
}

// A vertex goes to the piece of its own region whose cell beside it has the largest ball.
std::vector<std::uint32_t> label_vertices_by_piece(const DelaunayComplex& complex,
                                                   const VertexCells& vertex_cells,
                                                   const Basins& basins, const BasinGroups& groups,
                                                   const Pieces& pieces, int threads) {
  std::vector<std::uint32_t> piece_of_vertex(complex.vertices.size(), kNoBasin);
  const auto label = [&](std::size_t v) {
    const std::uint32_t basin = groups.basin_of_vertex[v];
    if (basin == kNoBasin) return;
    double largest = 0.0;
    piece_of_vertex[v] = pieces.piece_of_cell[basins.maximum[basin]];
    for (const std::uint32_t c : vertex_cells.of(v)) {
      const std::uint32_t b = basins.basin_of_cell[c];
      if (b == kNoBasin || groups.region_of_basin[b] != groups.region_of_basin[basin]) continue;
      // Balls that differ by rounding alone count as equal; the first cell is then as good.
      if (complex.radii[c] <= largest * (1.0 + 1e-9)) continue;
      largest = complex.radii[c];
      piece_of_vertex[v] = pieces.piece_of_cell[c];
    }
  };
  parallel_ranges(piece_of_vertex.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) label(v);
  });
  return piece_of_vertex;
}

// Touching pieces with the merge ratio of their regions; their facets are still to be measured.
std::vector<PieceContact> piece_contacts(const DelaunayComplex& complex, const Basins& basins,
                                         const BasinGroups& groups, const Pieces& pieces,
                                         const std::vector<Neck>& piece_necks, double spacing) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> region_ratio;
  for (const Neck& neck : groups.necks) {
    const auto regions =
        std::minmax(groups.region_of_basin[neck.a], groups.region_of_basin[neck.b]);
    const double ratio = merge_ratio(complex, basins, neck, kRadiusTolerance * spacing);
    const auto [held, fresh] = region_ratio.try_emplace(regions, ratio);
    if (!fresh) held->second = std::min(held->second, ratio);
  }
  std::vector<PieceContact> contacts;
  for (const Neck& neck : piece_necks) {
    const auto regions = std::minmax(pieces.region[neck.a], pieces.region[neck.b]);
    const bool one = regions.first == regions.second;
    PieceContact& contact = contacts.emplace_back();
    contact.a = neck.a;
    contact.b = neck.b;
    contact.ratio = one ? 1.0 : region_ratio.at(regions);
  }
  return contacts;
}

double mean_of_corners(const DelaunayComplex& complex, std::size_t cell, int slot,
                       const std::vector<double>& of_vertex) {
  double sum = 0.0;
  for (const int k : kFacetSlots[slot]) sum += of_vertex[complex.cells[cell][k]];
  return sum / 3.0;
}

// The facets between pieces, whose contacts ascend, and between a piece and the outside.
void measure_facets(const DelaunayComplex& complex, const std::vector<std::uint32_t>& piece_of_cell,
                    const std::vector<double>& concavity, PieceGraph& graph) {
  std::vector<double> in_crease(concavity);
  for (double& value : in_crease) value = creased(value);
  graph.surface.assign(graph.point_count.size(), 0.0);
  const auto pair_of = [](const PieceContact& contact) { return std::pair(contact.a, contact.b); };
  in_turn(complex.cell_count(), [&](std::size_t c) {
    const std::uint32_t a = piece_of_cell[c];
    for (int i = 0; a != kNoBasin && i < 4; ++i) {
      const std::uint32_t d = complex.neighbors[c][i];
      const std::uint32_t b = d == kNoCell ? kNoBasin : piece_of_cell[d];
      if (b <= a) continue;  // kNoBasin is larger than any
      const double area = area_of(facet_of(complex, c, i));
      if (b == kNoBasin) {
        graph.surface[a] += area;
      } else {
        PieceContact& contact =
            *std::ranges::lower_bound(graph.contacts, std::pair(a, b), {}, pair_of);
        contact.area += area;
        contact.facets += 1.0;
        contact.concavity += mean_of_corners(complex, c, i, concavity);
        contact.creased += mean_of_corners(complex, c, i, in_crease);
      }
    }
  });
}

// What the objects, the groups of pieces that touch, have altogether.
void measure_objects(PieceGraph& graph) {
  const std::size_t count = graph.point_count.size();
  UnionFind objects(count);
  for (const PieceContact& contact : graph.contacts) objects.join(contact.a, contact.b);
  std::vector<double> points(count, 0.0);
  std::vector<double> surface(count, 0.0);
  for (std::uint32_t p = 0; p < count; ++p) {
    points[objects.root(p)] += std::max(graph.point_count[p], 1.0);
    surface[objects.root(p)] += graph.surface[p];
  }
  for (std::uint32_t p = 0; p < count; ++p) {
    graph.object_count.push_back(points[objects.root(p)]);
    graph.object_radius.push_back(std::sqrt(surface[objects.root(p)] / (4.0 * std::numbers::pi)));
  }
}

PieceGraph make_piece_graph(const DelaunayComplex& complex,
                            const std::vector<std::uint32_t>& piece_of_cell, const MergeTree& tree,
                            const std::vector<double>& concavity,
                            std::vector<PieceContact> contacts) {
  PieceGraph graph;
  graph.contacts = std::move(contacts);
  graph.point_count.assign(tree.point_count.begin(), tree.point_count.end());
  graph.thickness = tree.ball_radius;
  measure_facets(complex, piece_of_cell, concavity, graph);
  measure_objects(graph);
  return graph;
}

void assign_points(const DelaunayComplex& complex,
                   const std::vector<std::uint32_t>& piece_of_vertex, MergeTree& tree) {
  tree.point_count = count_points(complex, piece_of_vertex, tree.moments.size());
  tree.piece_of_point.reserve(complex.vertex_of_point.size());
  for (const std::uint32_t v : complex.vertex_of_point) {
    tree.piece_of_point.push_back(v == kNoVertex ? kNoBasin : piece_of_vertex[v]);
  }
}

MergeTree build_as_published(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                             const Interior& interior, const Basins& basins, int threads) {
  MergeTree tree;
  tree.natural_ratio = 1.5;
  tree.necks = find_necks(complex, basins.basin_of_cell, threads);
  sum_pieces(complex, interior, basins.basin_of_cell, basins.count(), tree);
  tree.merges = link(complex, basins, tree.necks, 0.0);
  assign_points(complex, label_vertices(complex, vertex_cells, basins, tree.necks, threads), tree);
  // The paper keeps small segments; only its matching leaves them out.
  for (Merge& merge : tree.merges) merge.significant = true;
  tree.component_count = basins.count() - tree.merges.size();
  return tree;
}

}  // namespace

Moments& Moments::operator+=(const Moments& other) {
  volume += other.volume;
  first = first + other.first;
  for (std::size_t i = 0; i < second.size(); ++i) second[i] += other.second[i];
  return *this;
}

MergeTree build_merge_tree(const DelaunayComplex& complex, const VertexCells& vertex_cells,
                           const std::vector<double>& lambda, const Interior& interior,
                           const Basins& basins, Method method, int threads) {
  if (method == Method::kPaper) {
    return build_as_published(complex, vertex_cells, interior, basins, threads);
  }
  const double spacing = lambda.empty() ? 0.0
                                        : std::accumulate(lambda.begin(), lambda.end(), 0.0) /
                                              static_cast<double>(lambda.size());
  const BasinGroups groups = group_basins(complex, vertex_cells, basins, spacing, threads);
  SightSearch sight(complex, interior, spacing, threads);
  const Pieces pieces =
      split_regions(complex, basins, groups.region_of_basin, groups.object_of_basin, spacing,
                    threads, [&](std::uint32_t seed, double extent) { sight.add(seed, extent); });
  MergeTree tree;
  tree.natural_ratio = natural_merge_ratio();
  tree.necks = find_necks(complex, pieces.piece_of_cell, threads);
  sum_pieces(complex, interior, pieces.piece_of_cell, pieces.count(), tree);
  assign_points(complex,
                label_vertices_by_piece(complex, vertex_cells, basins, groups, pieces, threads),
                tree);
  std::vector<PieceContact> contacts =
      piece_contacts(complex, basins, groups, pieces, tree.necks, spacing);
  const PieceGraph graph =
      make_piece_graph(complex, pieces.piece_of_cell, tree,
                       vertex_concavity(complex, interior, lambda), std::move(contacts));
  tree.merges = agglomerate(graph, sight.table());
  tree.component_count = pieces.count() - tree.merges.size();
  mark_significant(tree.point_count, tree.merges);
  rank_merges(tree.point_count, tree.natural_ratio, tree.merges);
  return tree;
}

}  // namespace morsel
