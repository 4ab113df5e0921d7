#include <algorithm>
#include <limits>
#include <map>
#include <morsel/error.hpp>
#include <morsel/segment.hpp>
#include <numeric>
#include <ranges>
#include <string>

#include "base/union_find.hpp"

namespace morsel {
namespace {

// The merge ratio that leaves `wanted` parts, or as close as the tree allows.
double ratio_for_parts(const MergeTree& tree, std::size_t wanted) {
  std::size_t parts = tree.component_count;
  for (const Merge& merge : std::views::reverse(tree.merges)) {
    if (parts >= wanted) return merge.ratio;
    parts += merge.significant ? 1 : 0;
  }
  return 1.0;
}

// The number (p) of each piece's group; groups are numbered by decreasing volume.
std::vector<int> number_groups(const MergeTree& tree, UnionFind& groups) {
  const std::size_t count = tree.moments.size();
  std::vector<double> volume(count, 0.0);
  std::vector<std::uint32_t> roots;
  for (std::uint32_t b = 0; b < count; ++b) {
    volume[groups.root(b)] += tree.moments[b].volume;
    if (groups.root(b) == b) roots.push_back(b);
  }
  std::ranges::stable_sort(roots,
                           [&](std::uint32_t a, std::uint32_t b) { return volume[a] > volume[b]; });
  std::vector<int> number_of_root(count, -1);
  for (std::size_t i = 0; i < roots.size(); ++i) number_of_root[roots[i]] = static_cast<int>(i);
  std::vector<int> numbers(count);
  for (std::uint32_t b = 0; b < count; ++b) numbers[b] = number_of_root[groups.root(b)];
  return numbers;
}

// Centre and covariance from sums about `origin`.
void finish_moments(const Moments& sum, const Vec3& origin, Part& part) {
  part.volume = sum.volume;
  if (sum.volume <= 0.0) return;
  const Vec3 mean = (1.0 / sum.volume) * sum.first;
  part.center = origin + mean;
  const std::array<double, 6> square{mean.x * mean.x, mean.x * mean.y, mean.x * mean.z,
                                     mean.y * mean.y, mean.y * mean.z, mean.z * mean.z};
  for (std::size_t i = 0; i < 6; ++i) {
    part.covariance[i] = sum.second[i] / sum.volume - square[i];
  }
}

void connect_parts(const MergeTree& tree, Parts& result) {
  std::map<std::pair<int, int>, double> necks;
  for (const Neck& neck : tree.necks) {
    const int a = result.part_of_piece[neck.a];
    const int b = result.part_of_piece[neck.b];
    if (a == b) continue;
    double& radius = necks[std::minmax(a, b)];
    radius = std::max(radius, neck.radius);
  }
  for (const auto& [pair, radius] : necks) {
    result.parts[pair.first].neighbors.push_back({pair.second, radius});
    result.parts[pair.second].neighbors.push_back({pair.first, radius});
  }
  for (Part& part : result.parts) std::ranges::sort(part.neighbors, {}, &PartNeighbor::part);
}

void number_objects(const MergeTree& tree, Parts& result) {
  UnionFind objects(tree.moments.size());
  for (const Merge& merge : tree.merges) objects.join(merge.a, merge.b);
  const std::vector<int> object_of_piece = number_groups(tree, objects);
  for (std::size_t b = 0; b < object_of_piece.size(); ++b) {
    result.parts[result.part_of_piece[b]].object = object_of_piece[b];
  }
}

void fill_parts(const MergeTree& tree, Parts& result) {
  std::vector<Moments> sums(result.parts.size());
  for (std::size_t b = 0; b < tree.moments.size(); ++b) {
    const int p = result.part_of_piece[b];
    sums[p] += tree.moments[b];
    if (tree.ball_radius[b] > result.parts[p].ball_radius) {
      result.parts[p].ball_radius = tree.ball_radius[b];
      result.parts[p].ball_center = tree.ball_center[b];
    }
  }
  for (std::size_t p = 0; p < sums.size(); ++p) {
    finish_moments(sums[p], tree.origin, result.parts[p]);
  }
  connect_parts(tree, result);
  number_objects(tree, result);
  result.part_of_point.reserve(tree.piece_of_point.size());
  for (const std::uint32_t b : tree.piece_of_point) {
    result.part_of_point.push_back(b == kNoBasin ? -1 : result.part_of_piece[b]);
    if (b != kNoBasin) ++result.parts[result.part_of_piece[b]].point_count;
  }
}

}  // namespace

std::vector<MergeTree::Level> MergeTree::levels() const {
  std::vector<Level> levels;
  std::size_t parts = component_count;
  double to = std::numeric_limits<double>::infinity();
  for (const Merge& merge : std::views::reverse(merges)) {
    if (!merge.significant) continue;
    if (merge.ratio < to) levels.push_back({parts, merge.ratio, to});
    to = merge.ratio;
    ++parts;
  }
  if (to > 1.0) levels.push_back({parts, 1.0, to});
  return levels;
}

void CutOptions::check() const {
  if (parts && merge_ratio) {
    throw Error(ErrorCode::kUsage, "parts and merge_ratio are both given; give one of them");
  }
  if (parts && *parts < 1) throw Error(ErrorCode::kUsage, "parts is 0; it must be at least 1");
  if (merge_ratio && !(*merge_ratio >= 1.0)) {
    throw Error(ErrorCode::kUsage,
                "merge_ratio is " + std::to_string(*merge_ratio) + "; it must be at least 1");
  }
}

Parts cut(const MergeTree& tree, const CutOptions& options) {
  options.check();
  Parts result;
  result.merge_ratio = options.parts ? ratio_for_parts(tree, *options.parts)
                                     : options.merge_ratio.value_or(tree.natural_ratio);
  const std::size_t count = tree.moments.size();
  UnionFind groups(count);
  for (const Merge& merge : tree.merges) {
    if (!merge.significant || merge.ratio <= result.merge_ratio) groups.join(merge.a, merge.b);
  }
  result.part_of_piece = number_groups(tree, groups);
  for (const int part : result.part_of_piece) {
    result.parts.resize(std::max(result.parts.size(), static_cast<std::size_t>(part) + 1));
  }
  fill_parts(tree, result);
  return result;
}

}  // namespace morsel
