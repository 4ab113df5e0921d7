#include "segment/rank.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/union_find.hpp"

namespace morsel {
namespace {

// A piece or group of pieces with a smaller share of its object's points is no part of its own.
constexpr double kSmallestShare = 0.0075;
// worth = tanh(kSureness · ln(cost / natural cost)) · (share · share)^kSharePower
// ratio = exp(natural cost · exp(kSpread · mean worth)); tuned like the cost (agglomerate.cpp).
constexpr double kSureness = 0.5;
constexpr double kSharePower = 0.3;
constexpr double kSpread = 2.0;

constexpr std::uint32_t kNone = 0xFFFFFFFF;

// Points of the two sides of a merge and of their object.
struct Sides {
  double a = 0.0;
  double b = 0.0;
  double object = 0.0;
};

std::vector<Sides> measure_sides(const std::vector<std::uint32_t>& point_count,
                                 const std::vector<Merge>& merges) {
  UnionFind groups(point_count.size());
  std::vector<double> points(point_count.begin(), point_count.end());
  std::vector<Sides> sides;
  for (const Merge& merge : merges) {
    const double a = points[groups.root(merge.a)];
    const double b = points[groups.root(merge.b)];
    sides.push_back({a, b, 0.0});
    groups.join(merge.a, merge.b);
    points[groups.root(merge.a)] = a + b;
  }
  for (std::size_t m = 0; m < merges.size(); ++m) {
    sides[m].object = points[groups.root(merges[m].a)];
  }
  return sides;
}

// What undoing a significant merge gains, and the significant merges of its two sides.
struct Split {
  std::uint32_t merge = 0;
  double worth = 0.0;
  std::uint32_t sides[2] = {kNone, kNone};
};

// In the order of the merges, so that both sides come before what joins them.
std::vector<Split> find_splits(const std::vector<std::uint32_t>& point_count, double natural_ratio,
                               const std::vector<Merge>& merges) {
  const std::vector<Sides> sides = measure_sides(point_count, merges);
  std::vector<Split> splits;
  UnionFind groups(point_count.size());
  std::vector<std::uint32_t> last_split(point_count.size(), kNone);
  for (std::uint32_t m = 0; m < merges.size(); ++m) {
    const Merge& merge = merges[m];
    const std::uint32_t a = groups.root(merge.a);
    const std::uint32_t b = groups.root(merge.b);
    std::uint32_t last = std::min(last_split[a], last_split[b]);  // a small side has none
    if (merge.significant) {
      const auto& [points_a, points_b, all] = sides[m];
      const double sureness =
          std::tanh(kSureness * std::log(std::log(merge.ratio) / std::log(natural_ratio)));
      const double size = std::pow(points_a / all * points_b / all, kSharePower);
      last = static_cast<std::uint32_t>(splits.size());
      splits.push_back({m, sureness * size, {last_split[a], last_split[b]}});
    }
    groups.join(a, b);
    last_split[groups.root(a)] = last;
  }
  return splits;
}

// Splits that are made together, beginning with the uppermost, and those right below them.
struct Pool {
  double worth = 0.0;  // of all
  std::vector<std::uint32_t> splits;
  std::vector<std::uint32_t> below;

  [[nodiscard]] double mean() const { return worth / static_cast<double>(splits.size()); }
};

// The pool that begins with each split: nothing below it is worth more on average.
std::vector<Pool> pool_splits(const std::vector<Split>& splits) {
  std::vector<Pool> pools(splits.size());
  for (std::uint32_t s = 0; s < splits.size(); ++s) {
    Pool& pool = pools[s];
    pool.worth = splits[s].worth;
    pool.splits.push_back(s);
    for (const std::uint32_t side : splits[s].sides) {
      if (side != kNone) pool.below.push_back(side);
    }
    while (!pool.below.empty()) {
      const auto best = std::ranges::max_element(
          pool.below, {}, [&](std::uint32_t below) { return pools[below].mean(); });
      const Pool& other = pools[*best];
      if (other.mean() <= pool.mean()) break;
      pool.below.erase(best);
      pool.worth += other.worth;
      pool.splits.insert(pool.splits.end(), other.splits.begin(), other.splits.end());
      pool.below.insert(pool.below.end(), other.below.begin(), other.below.end());
    }
  }
  return pools;
}

}  // namespace

void mark_significant(const std::vector<std::uint32_t>& point_count, std::vector<Merge>& merges) {
  const std::vector<Sides> sides = measure_sides(point_count, merges);
  for (std::size_t m = 0; m < merges.size(); ++m) {
    const auto& [a, b, all] = sides[m];
    merges[m].significant = std::min(a, b) >= kSmallestShare * all;
  }
}

void rank_merges(const std::vector<std::uint32_t>& point_count, double natural_ratio,
                 std::vector<Merge>& merges) {
  const std::vector<Split> splits = find_splits(point_count, natural_ratio, merges);
  const std::vector<Pool> pools = pool_splits(splits);
  for (Merge& merge : merges) merge.ratio = 1.0;  // what is always carried out comes first
  std::vector<bool> ranked(splits.size(), false);
  for (std::size_t s = splits.size(); s-- > 0;) {  // those above first: theirs is the larger pool
    if (ranked[s]) continue;
    const double ratio = std::pow(natural_ratio, std::exp(kSpread * pools[s].mean()));
    for (const std::uint32_t member : pools[s].splits) {
      ranked[member] = true;
      merges[splits[member].merge].ratio = ratio;
    }
  }
  std::ranges::stable_sort(merges, {}, &Merge::ratio);
  double least = 1.0;  // strictly rising, so that a ratio can tell any two merges apart
  for (Merge& merge : merges) {
    merge.ratio = std::max(merge.ratio, least);
    least = merge.ratio * (1.0 + 1e-9);
  }
}

}  // namespace morsel
