#include "measures.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/point_tree.hpp"

namespace morsel::bench {
namespace {

std::vector<int> distinct(std::span<const int> labels) {
  std::vector<int> values(labels.begin(), labels.end());
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t position(const std::vector<int>& values, int value) {
  return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) -
                                  values.begin());
}

std::uint64_t pairs_of(std::uint64_t count) { return count * (count - 1) / 2; }

std::uint64_t pairs_within(const std::vector<std::uint64_t>& parts) {
  std::uint64_t pairs = 0;
  for (const std::uint64_t count : parts) pairs += pairs_of(count);
  return pairs;
}

double share(std::uint64_t count, std::uint64_t total) {
  return total == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(total);
}

double refinement_error(std::uint64_t overlap, std::uint64_t part) {
  return share(part - overlap, part);
}

double one_way_discrepancy(const Cuts& from, const Cuts& to) {
  const PointTree tree(to.midpoints);
  double sum = 0.0;
  double length = 0.0;
  for (std::size_t i = 0; i < from.midpoints.size(); ++i) {
    sum += from.lengths[i] * tree.nearest(from.midpoints[i]).distance;
    length += from.lengths[i];
  }
  return length > 0.0 ? sum / length : 0.0;
}

// Over the surface, each triangle's mass at its centroid.
double mean_radius_of(const TriangleMesh& mesh) {
  std::vector<std::pair<Vec3, double>> masses;
  masses.reserve(mesh.triangles.size());
  Vec3 sum;
  double area_sum = 0.0;
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Vec3& a = mesh.vertices[ia];
    const Vec3& b = mesh.vertices[ib];
    const Vec3& c = mesh.vertices[ic];
    const double area = 0.5 * norm(cross(b - a, c - a));
    masses.emplace_back((1.0 / 3.0) * (a + b + c), area);
    sum = sum + area * masses.back().first;
    area_sum += area;
  }
  if (!(area_sum > 0.0)) return 0.0;
  const Vec3 centroid = (1.0 / area_sum) * sum;
  double radius = 0.0;
  for (const auto& [point, area] : masses) radius += area * distance(point, centroid);
  return radius / area_sum;
}

}  // namespace

Contingency count_pairs(std::span<const int> a, std::span<const int> b) {
  const std::vector<int> row_labels = distinct(a);
  const std::vector<int> column_labels = distinct(b);
  std::vector<std::uint64_t> counts(row_labels.size() * column_labels.size(), 0);
  Contingency table;
  table.rows.assign(row_labels.size(), 0);
  table.columns.assign(column_labels.size(), 0);
  table.total = a.size();
  for (std::size_t face = 0; face < a.size(); ++face) {
    const std::size_t row = position(row_labels, a[face]);
    const std::size_t column = position(column_labels, b[face]);
    ++table.rows[row];
    ++table.columns[column];
    ++counts[row * column_labels.size() + column];
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    table.cells.push_back({i / column_labels.size(), i % column_labels.size(), counts[i]});
  }
  return table;
}

double rand_error(const Contingency& table) {
  if (table.total < 2) return 0.0;
  std::uint64_t together_in_both = 0;
  for (const auto& cell : table.cells) together_in_both += pairs_of(cell.count);
  // Pairs together in one segmentation and apart in the other.
  const std::uint64_t differing =
      pairs_within(table.rows) + pairs_within(table.columns) - 2 * together_in_both;
  return share(differing, pairs_of(table.total));
}

double missing_rate(const Contingency& table) {
  std::vector<std::uint64_t> best(table.columns.size(), 0);
  for (const auto& cell : table.cells) best[cell.column] = std::max(best[cell.column], cell.count);
  const auto found = std::accumulate(best.begin(), best.end(), std::uint64_t{0});
  return share(table.total - found, table.total);
}

double false_alarm_rate(const Contingency& table) {
  std::vector<std::uint64_t> best(table.rows.size(), 0);
  for (const auto& cell : table.cells) best[cell.row] = std::max(best[cell.row], cell.count);
  const auto found = std::accumulate(best.begin(), best.end(), std::uint64_t{0});
  return share(table.total - found, table.total);
}

double global_consistency_error(const Contingency& table) {
  double by_rows = 0.0;
  double by_columns = 0.0;
  for (const auto& cell : table.cells) {
    const auto count = static_cast<double>(cell.count);
    by_rows += count * refinement_error(cell.count, table.rows[cell.row]);
    by_columns += count * refinement_error(cell.count, table.columns[cell.column]);
  }
  return table.total == 0 ? 0.0 : std::min(by_rows, by_columns) / static_cast<double>(table.total);
}

double local_consistency_error(const Contingency& table) {
  double sum = 0.0;
  for (const auto& cell : table.cells) {
    sum += static_cast<double>(cell.count) *
           std::min(refinement_error(cell.count, table.rows[cell.row]),
                    refinement_error(cell.count, table.columns[cell.column]));
  }
  return table.total == 0 ? 0.0 : sum / static_cast<double>(table.total);
}

MeshEdges find_edges(const TriangleMesh& mesh) {
  struct Side {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::uint32_t face = 0;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    const auto& corners = mesh.triangles[face];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax({corners[i], corners[(i + 1) % 3]});
      sides.push_back({low, high, static_cast<std::uint32_t>(face)});
    }
  }
  std::sort(sides.begin(), sides.end());
  MeshEdges result;
  result.mean_radius = mean_radius_of(mesh);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i - 1].low != sides[i].low || sides[i - 1].high != sides[i].high) continue;
    const Vec3& a = mesh.vertices[sides[i].low];
    const Vec3& b = mesh.vertices[sides[i].high];
    result.edges.push_back({0.5 * (a + b), distance(a, b), {sides[i - 1].face, sides[i].face}});
  }
  return result;
}

Cuts find_cuts(const MeshEdges& edges, std::span<const int> labels) {
  Cuts cuts;
  for (const auto& edge : edges.edges) {
    if (labels[edge.faces[0]] == labels[edge.faces[1]]) continue;
    cuts.midpoints.push_back(edge.midpoint);
    cuts.lengths.push_back(edge.length);
  }
  return cuts;
}

std::optional<double> cut_discrepancy(const Cuts& a, const Cuts& b, double mean_radius) {
  if (a.midpoints.empty() && b.midpoints.empty()) return 0.0;
  if (a.midpoints.empty() || b.midpoints.empty() || !(mean_radius > 0.0)) return std::nullopt;
  return (one_way_discrepancy(a, b) + one_way_discrepancy(b, a)) / mean_radius;
}

Scores compare_with_people(const TriangleMesh& mesh, std::span<const int> labels,
                           std::span<const std::vector<int>> people) {
  const MeshEdges edges = find_edges(mesh);
  const Cuts cuts = find_cuts(edges, labels);
  std::vector<Scores> all;
  for (const auto& person : people) {
    const Contingency table = count_pairs(labels, person);
    Scores scores;
    scores[kRand] = rand_error(table);
    scores[kCutDiscrepancy] = cut_discrepancy(cuts, find_cuts(edges, person), edges.mean_radius);
    scores[kMissingRate] = missing_rate(table);
    scores[kFalseAlarmRate] = false_alarm_rate(table);
    scores[kHamming] = 0.5 * (*scores[kMissingRate] + *scores[kFalseAlarmRate]);
    scores[kGlobalConsistency] = global_consistency_error(table);
    scores[kLocalConsistency] = local_consistency_error(table);
    all.push_back(scores);
  }
  return mean_scores(all);
}

Scores mean_scores(std::span<const Scores> scores) {
  Scores mean;
  for (std::size_t measure = 0; measure < kMeasureCount; ++measure) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const Scores& one : scores) {
      if (!one[measure]) continue;
      sum += *one[measure];
      ++count;
    }
    if (count > 0) mean[measure] = sum / static_cast<double>(count);
  }
  return mean;
}

std::size_t count_labels(std::span<const int> labels) { return distinct(labels).size(); }

}  // namespace morsel::bench
