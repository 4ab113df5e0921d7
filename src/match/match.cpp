#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <morsel/error.hpp>
#include <morsel/match.hpp>
#include <vector>

#include "match/align.hpp"
#include "match/paper.hpp"
#include "match/score.hpp"

namespace morsel {
namespace {

// In the order of MatchMode.
constexpr std::array<std::string_view, 3> kModeNames{"rigid", "articulated", "partial"};

// x ↦ scale · turn · (x - source centroid) + target centroid + shift.
std::array<double, 16> transform(const Signature& target, const Signature& source,
                                 const Alignment& alignment) {
  const Eigen::Matrix3d& turn = alignment.target_from_source;
  const double scale = source.size > 0.0 ? target.size / source.size : 1.0;
  const Eigen::Vector3d to(target.centroid.x, target.centroid.y, target.centroid.z);
  const Eigen::Vector3d from(source.centroid.x, source.centroid.y, source.centroid.z);
  const Eigen::Vector3d shift = to + target.size * alignment.shift - scale * (turn * from);
  return as_matrix(scale * turn, shift);
}

// Of a shape that is nearly its own mirror image, noise alone would say which is which: mirrored
// only where that lays more onto each other by a hundredth.
Alignment clearest(const std::vector<Blob>& target, const std::vector<Blob>& source, bool mirror) {
  constexpr double kClearly = 1.01;
  Alignment best = align(target, source, mirror);
  if (best.target_from_source.determinant() > 0.0) return best;
  const Alignment proper = align(target, source, false);
  return best.overlap > kClearly * proper.overlap ? best : proper;
}

struct Pair {
  double overlap = 0.0;
  int target = 0;
  int source = 0;
};

// All pairs of parts, those that overlap most first.
std::vector<Pair> overlapping_pairs(const std::vector<Blob>& target,
                                    const std::vector<Blob>& source) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < target.size(); ++i) {
    for (std::size_t k = 0; k < source.size(); ++k) {
      pairs.push_back(
          {overlap({target[i]}, {source[k]}), static_cast<int>(i), static_cast<int>(k)});
    }
  }
  std::ranges::stable_sort(pairs, std::ranges::greater{}, &Pair::overlap);
  return pairs;
}

double total_overlap(const std::vector<Pair>& pairs) {
  double total = 0.0;
  for (const Pair& pair : pairs) total += pair.overlap;
  return total;
}

// For each blob the one of the others whose mean is nearest.
std::vector<int> nearest_of(const std::vector<Blob>& blobs, const std::vector<Blob>& others) {
  std::vector<int> nearest;
  for (const Blob& blob : blobs) {
    const auto found = std::ranges::min_element(
        others, {}, [&](const Blob& other) { return (other.mean - blob.mean).squaredNorm(); });
    nearest.push_back(static_cast<int>(found - others.begin()));
  }
  return nearest;
}

// Each part goes to the nearest of the other shape: a limb that was bent lies beside where it was,
// and what one posture cuts in two is one part in the other.
void pair_neighbors(const std::vector<Blob>& target, const std::vector<Blob>& source,
                    Match& result) {
  const std::vector<Pair> pairs = overlapping_pairs(target, source);
  const double total = total_overlap(pairs);
  const std::vector<int> of_target = nearest_of(target, source);
  const std::vector<int> of_source = nearest_of(source, target);
  for (const auto& [overlap, i, k] : pairs) {
    if (of_target[i] != k && of_source[k] != i) continue;
    result.matched.push_back({i, k, total > 0.0 ? overlap / total : 0.0});
  }
}

// Each part goes to the one that it overlaps most of those that are left.
void pair_parts(const std::vector<Blob>& target, const std::vector<Blob>& source, Match& result) {
  const std::vector<Pair> pairs = overlapping_pairs(target, source);
  const double total = total_overlap(pairs);
  std::vector<bool> target_taken(target.size(), false);
  std::vector<bool> source_taken(source.size(), false);
  for (const Pair& pair : pairs) {
    if (target_taken[pair.target] || source_taken[pair.source] || !(pair.overlap > 0.0)) continue;
    target_taken[pair.target] = source_taken[pair.source] = true;
    result.matched.push_back({pair.target, pair.source, pair.overlap / total});
  }
  for (std::size_t i = 0; i < target.size(); ++i) {
    if (!target_taken[i]) result.unmatched_target.push_back(static_cast<int>(i));
  }
  for (std::size_t k = 0; k < source.size(); ++k) {
    if (!source_taken[k]) result.unmatched_source.push_back(static_cast<int>(k));
  }
}

// A shape with an inside and one without have nothing in common.
bool comparable(const Signature& a, const Signature& b) { return (a.size > 0.0) == (b.size > 0.0); }

}  // namespace

std::string_view mode_name(MatchMode mode) { return kModeNames[static_cast<std::size_t>(mode)]; }

std::optional<MatchMode> mode_named(std::string_view name) {
  const auto* const at = std::ranges::find(kModeNames, name);
  if (at == kModeNames.end()) return std::nullopt;
  return static_cast<MatchMode>(at - kModeNames.begin());
}

void MatchOptions::check() const {
  if (method == Method::kPaper && mode != MatchMode::kRigid) {
    throw Error(ErrorCode::kUsage,
                fmt::format("mode: the paper's score has no {} mode; use rigid", mode_name(mode)));
  }
  if (same_scale && mode != MatchMode::kPartial) {
    throw Error(ErrorCode::kUsage,
                fmt::format("same_scale: only the mode 'partial' tells scales apart, not '{}'",
                            mode_name(mode)));
  }
}

void check_for_signatures(const MatchOptions& options) {
  options.check();
  if (options.mode == MatchMode::kPartial) {
    throw Error(ErrorCode::kUsage,
                "mode: signatures are of whole shapes; the partial mode compares their points");
  }
}

double match_score(const Signature& a, const Signature& b, const MatchOptions& options) {
  check_for_signatures(options);
  if (!comparable(a, b)) return 0.0;
  if (options.method == Method::kPaper) return paper_score(a, b, options.mirror).score;
  const auto tables_a = tables_of(a);
  const auto tables_b = tables_of(b);
  const double score = score_of_distance(table_distance(
      block_sums(tables_a.data(), tables_b.data()), tables_a[0], tables_b[0], options.mode));
  return options.mirror ? score : score * same_handedness(a, b);
}

Match match(const Signature& target, const Signature& source, const MatchOptions& options) {
  check_for_signatures(options);
  Match result;
  const std::vector<Blob> to = blobs_of(target);
  const std::vector<Blob> from = blobs_of(source);
  Alignment alignment;
  if (options.method == Method::kPaper) {
    const PaperMatch paper = paper_score(target, source, options.mirror);
    result.score = comparable(target, source) ? paper.score : 0.0;
    alignment = paper.alignment;
  } else {
    result.score = match_score(target, source, options);
    alignment = clearest(to, from, options.mirror);
  }
  result.target_from_source = transform(target, source, alignment);
  result.mirrored = alignment.target_from_source.determinant() < 0.0;
  if (options.mode == MatchMode::kArticulated) {
    pair_neighbors(to, moved(from, alignment), result);
  } else {
    pair_parts(to, moved(from, alignment), result);
  }
  return result;
}

}  // namespace morsel
