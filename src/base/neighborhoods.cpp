#include "base/neighborhoods.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "base/box.hpp"
#include "base/point_tree.hpp"
#include "base/threads.hpp"
#include "base/unit_scale.hpp"

namespace morsel {
namespace {

constexpr std::size_t kLeafPoints = 12;  // at most
constexpr std::uint32_t kNoIndex = std::numeric_limits<std::uint32_t>::max();

// Points along the leaves of a k-d tree, each coordinate by itself, as loops over them want it.
struct Column {
  std::vector<double> x, y, z;
  std::vector<std::uint32_t> index;  // in the cloud

  void resize(std::size_t count) {
    for (auto* axis : {&x, &y, &z}) axis->resize(count);
    index.resize(count);
  }
};

// A balanced tree: nodes are numbered as in a heap and halve their points, so that only their boxes
// need to be kept.
class Tree {
 public:
  Tree(std::span<const Vec3> points, double scale);

  [[nodiscard]] std::size_t leaf_count() const { return std::size_t{1} << depth_; }
  [[nodiscard]] std::size_t begin_of_leaf(std::size_t leaf) const {
    return leaf * column_.index.size() >> depth_;
  }
  [[nodiscard]] const Column& column() const { return column_; }

  // The points no farther from `center` than the root of `squared` go to `near`, which is made as
  // large as that takes.
  std::size_t collect(const Vec3& center, double squared, Column& near) const;

 private:
  struct Entry {
    Vec3 point;
    std::uint32_t index;
  };

  void split(std::vector<Entry>& entries, std::size_t node, std::size_t leaf, std::size_t leaves);

  int depth_ = 0;
  Column column_;
  std::vector<Box> boxes_;  // of the nodes, from 1; the leaves come last
};

Tree::Tree(std::span<const Vec3> points, double scale) {
  while ((points.size() - 1) >> depth_ >= kLeafPoints) ++depth_;
  std::vector<Entry> entries(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    entries[i] = {scale * points[i], static_cast<std::uint32_t>(i)};
  }
  boxes_.resize(2 * leaf_count());
  column_.resize(points.size());
  split(entries, 1, 0, leaf_count());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    column_.x[i] = entries[i].point.x;
    column_.y[i] = entries[i].point.y;
    column_.z[i] = entries[i].point.z;
    column_.index[i] = entries[i].index;
  }
}

void Tree::split(std::vector<Entry>& entries, std::size_t node, std::size_t leaf,
                 std::size_t leaves) {
  const auto at = [&](std::size_t l) {
    return entries.begin() + static_cast<std::ptrdiff_t>(begin_of_leaf(l));
  };
  Box& box = boxes_[node];
  for (auto e = at(leaf); e != at(leaf + leaves); ++e) box.add(e->point);
  if (leaves == 1) {
    std::sort(at(leaf), at(leaf + 1),
              [](const Entry& a, const Entry& b) { return a.index < b.index; });
    return;
  }
  const auto halve = [&](double Vec3::*axis) {
    std::nth_element(
        at(leaf), at(leaf + leaves / 2), at(leaf + leaves), [axis](const Entry& a, const Entry& b) {
          return a.point.*axis != b.point.*axis ? a.point.*axis < b.point.*axis : a.index < b.index;
        });
  };
  const Vec3 side = box.high - box.low;
  halve(side.x >= side.y && side.x >= side.z ? &Vec3::x : side.y >= side.z ? &Vec3::y : &Vec3::z);
  split(entries, 2 * node, leaf, leaves / 2);
  split(entries, 2 * node + 1, leaf + leaves / 2, leaves / 2);
}

std::size_t Tree::collect(const Vec3& center, double squared, Column& near) const {
  struct Range {
    std::size_t node, leaf, leaves;
  };
  std::array<Range, 64> open;  // one for each level at most
  std::size_t opened = 0;
  std::size_t count = 0;
  open[opened++] = {1, 0, leaf_count()};
  while (opened > 0) {
    const Range range = open[--opened];
    const Box& box = boxes_[range.node];
    const Vec3 off{std::max({box.low.x - center.x, center.x - box.high.x, 0.0}),
                   std::max({box.low.y - center.y, center.y - box.high.y, 0.0}),
                   std::max({box.low.z - center.z, center.z - box.high.z, 0.0})};
    if (squared_norm(off) > squared) continue;
    if (range.leaves > 1) {
      const std::size_t half = range.leaves / 2;
      open[opened++] = {2 * range.node + 1, range.leaf + half, half};
      open[opened++] = {2 * range.node, range.leaf, half};
      continue;
    }
    const std::size_t end = begin_of_leaf(range.leaf + 1);
    if (near.index.size() < count + kLeafPoints) near.resize(2 * (count + kLeafPoints));
    for (std::size_t i = begin_of_leaf(range.leaf); i < end; ++i) {
      const Vec3 p{column_.x[i], column_.y[i], column_.z[i]};
      near.x[count] = p.x;
      near.y[count] = p.y;
      near.z[count] = p.z;
      near.index[count] = column_.index[i];
      count += squared_distance(p, center) <= squared ? 1 : 0;
    }
  }
  return count;
}

// Said by the sign of the difference, as compilers make no vectors of comparisons.
std::size_t count_up_to(std::span<const float> values, float most) {
  std::uint32_t above = 0;
  for (const float value : values) above += std::bit_cast<std::uint32_t>(most - value) >> 31;
  return values.size() - above;
}

// Some value that exactly `wanted` of the others do not exceed; none where equal ones stand in the
// way. On a surface the number of neighbours grows with the square of the distance.
std::optional<float> find_threshold(std::span<const float> values, std::size_t wanted,
                                    float guess) {
  constexpr int kGuesses = 40;
  float low = 0.0F;
  float high = std::numeric_limits<float>::infinity();
  for (int i = 0; i < kGuesses; ++i) {
    const std::size_t found = count_up_to(values, guess);
    if (found == wanted) return guess;
    (found < wanted ? low : high) = guess;
    guess *= static_cast<float>(wanted) / static_cast<float>(std::max<std::size_t>(found, 1));
    if (guess > low && guess < high) continue;
    guess = high < std::numeric_limits<float>::infinity() ? 0.5F * (low + high) : 2.0F * low;
  }
  return std::nullopt;
}

// Finds the neighbours of the points of one leaf after the other, on one thread.
class Search {
 public:
  // Of a point those neighbours are found whose row it is; of others none.
  Search(const Tree& tree, std::size_t inner, const std::vector<std::uint32_t>& row_of_point,
         Neighborhoods& found)
      : tree_(tree), inner_(inner), row_of_point_(row_of_point), found_(found) {}

  // Of the points from begin to end along the tree's leaves.
  void visit(std::size_t begin, std::size_t end);

 private:
  // What is taken ends here, by squared distance and then by index.
  struct Cut {
    double squared;
    std::uint32_t index;

    // As many have no larger distances when they are rounded, which exchanges no two.
    [[nodiscard]] bool is_clear() const { return index == kNoIndex; }
    [[nodiscard]] bool takes(double other) const {
      return static_cast<float>(other) <= static_cast<float>(squared);
    }
    [[nodiscard]] bool takes(double other, std::uint32_t other_index) const {
      return (other < squared) | ((other == squared) & (other_index <= index));
    }
  };

  [[nodiscard]] Vec3 place(std::size_t i) const {
    const Column& column = tree_.column();
    return {column.x[i], column.y[i], column.z[i]};
  }
  [[nodiscard]] bool is_asked(std::size_t i) const {
    return row_of_point_[tree_.column().index[i]] != kNoIndex;
  }
  [[nodiscard]] std::size_t middle_of(std::size_t begin, std::size_t end) const;
  void measure(const Vec3& from, const Column& to, std::size_t begin, std::size_t end);
  std::optional<float> part(std::size_t count, std::size_t wanted, double guess);
  [[nodiscard]] Cut find_cut(std::size_t count, std::size_t wanted, double guess,
                             std::uint32_t self);
  std::size_t find_near(const Vec3& center, double radius, double& reach);
  double find(std::size_t i, std::size_t near, double most, double guess);

  // The square of both lengths together, wider than computed by more than the rounding to floats,
  // also where squares are so small that they lose digits.
  [[nodiscard]] static double bound(double a, double b) {
    constexpr double kMargin = 1.000001;
    constexpr double kLeast = 1e-19;
    const double sum = a + b + kLeast;
    return kMargin * sum * sum;
  }
  // A leaf is halved when it is so many times wider than the neighbourhood of its middle.
  static constexpr double kWide = 4.0;

  const Tree& tree_;
  std::size_t inner_;
  const std::vector<std::uint32_t>& row_of_point_;
  Neighborhoods& found_;
  Column near_;  // holds the neighbours of all points of a leaf
  // Of those, or of those that are taken.
  std::vector<double> squared_;
  std::vector<float> rounded_;
  std::vector<std::uint32_t> index_;
};

// The one nearest to the middle of their box.
std::size_t Search::middle_of(std::size_t begin, std::size_t end) const {
  Box box;
  for (std::size_t i = begin; i < end; ++i) box.add(place(i));
  const Vec3 middle = 0.5 * (box.low + box.high);
  std::size_t best = begin;
  for (std::size_t i = begin + 1; i < end; ++i) {
    if (squared_distance(place(i), middle) < squared_distance(place(best), middle)) best = i;
  }
  return best;
}

void Search::measure(const Vec3& from, const Column& to, std::size_t begin, std::size_t end) {
  if (squared_.size() < end - begin) {
    squared_.resize(2 * (end - begin));
    rounded_.resize(squared_.size());
    index_.resize(squared_.size());
  }
  double* squared = squared_.data();
  const double* x = to.x.data() + begin;
  const double* y = to.y.data() + begin;
  const double* z = to.z.data() + begin;
  for (std::size_t i = 0; i < end - begin; ++i) {
    squared[i] = squared_distance(from, {x[i], y[i], z[i]});
  }
}

// What exactly `wanted` of the first `count` do not exceed as floats, which are counted in half the
// time.
std::optional<float> Search::part(std::size_t count, std::size_t wanted, double guess) {
  for (std::size_t i = 0; i < count; ++i) rounded_[i] = static_cast<float>(squared_[i]);
  return find_threshold({rounded_.data(), count}, wanted, static_cast<float>(guess));
}

// `self` comes first, also where other distances vanish.
Search::Cut Search::find_cut(std::size_t count, std::size_t wanted, double guess,
                             std::uint32_t self) {
  if (const auto threshold = part(count, wanted, guess)) return {*threshold, kNoIndex};
  std::vector<std::pair<double, std::uint32_t>> sorted;
  for (std::size_t i = 0; i < count; ++i) {
    sorted.emplace_back(index_[i] == self ? -1.0 : squared_[i], index_[i]);
  }
  std::ranges::sort(sorted);
  return {sorted[wanted - 1].first, sorted[wanted - 1].second};
}

// Gathers the points within `reach` and twice `radius` of the center, where `reach` is first
// brought down to what it takes to hold enough. Returns how many there are.
std::size_t Search::find_near(const Vec3& center, double radius, double& reach) {
  const std::size_t count = tree_.collect(center, bound(reach, 2.0 * radius), near_);
  measure(center, near_, 0, count);
  const auto least = part(count, found_.size + 1, reach * reach);
  if (least) reach = std::min(reach, std::sqrt(static_cast<double>(*least)));
  const double most = bound(reach, 2.0 * radius);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    near_.x[kept] = near_.x[i];
    near_.y[kept] = near_.y[i];
    near_.z[kept] = near_.z[i];
    near_.index[kept] = near_.index[i];
    kept += squared_[i] <= most ? 1 : 0;
  }
  return kept;
}

void Search::visit(std::size_t begin, std::size_t end) {
  const Column& all = tree_.column();
  const std::size_t wanted = found_.size + 1;  // with the point itself
  const Vec3 center = place(middle_of(begin, end));
  double radius = -1.0;
  for (std::size_t i = begin; i < end; ++i) {
    if (is_asked(i)) radius = std::max(radius, distance(center, place(i)));
  }
  if (radius < 0.0) return;
  const std::size_t first = begin - std::min(begin, 2 * wanted);
  const std::size_t last = std::min(end + 2 * wanted, all.index.size());
  measure(center, all, first, last);
  const auto some = part(last - first, wanted, radius * radius);
  double reach =
      std::sqrt(some ? static_cast<double>(*some)
                     : *std::max_element(squared_.data(), squared_.data() + (last - first)));
  if (radius > kWide * reach && end - begin > 1) {
    visit(begin, begin + (end - begin) / 2);
    visit(begin + (end - begin) / 2, end);
    return;
  }
  // Around a point that is d from the center there are as many within reach + d.
  const std::size_t near = find_near(center, radius, reach);
  double guess = reach * reach;
  for (std::size_t i = begin; i < end; ++i) {
    if (!is_asked(i)) continue;
    guess = find(i, near, bound(reach, distance(center, place(i))), guess);
  }
}

// Keeps those of the first `count` that `takes` accepts, in order; returns how many. Without a
// branch: which ones it will be cannot be foreseen.
template <typename Takes>
std::size_t keep(double* squared, std::uint32_t* index, const std::uint32_t* from,
                 std::size_t count, const Takes& takes) {
  std::size_t kept = 0;
  for (std::size_t j = 0; j < count; ++j) {
    const double value = squared[j];
    const std::uint32_t point = from[j];
    squared[kept] = value;
    index[kept] = point;
    kept += takes(value, point) ? 1 : 0;
  }
  return kept;
}

// Of point i, all of whose neighbours are among the first `near`, no farther than the root of
// `most`. Returns what to guess for the next point.
double Search::find(std::size_t i, std::size_t near, double most, double guess) {
  const std::uint32_t self = tree_.column().index[i];
  const std::uint32_t row = row_of_point_[self];
  measure(place(i), near_, 0, near);
  double* squared = squared_.data();
  std::uint32_t* index = index_.data();
  std::size_t count = keep(squared, index, near_.index.data(), near,
                           [most](double value, std::uint32_t) { return value <= most; });
  const Cut outer = find_cut(count, found_.size + 1, guess, self);
  const auto others = [&](const auto& takes) {
    return keep(squared, index, index, count, [&](double value, std::uint32_t point) {
      return takes(value, point) & (point != self);
    });
  };
  count =
      outer.is_clear()
          ? others([&](double value, std::uint32_t) { return outer.takes(value); })
          : others([&](double value, std::uint32_t point) { return outer.takes(value, point); });
  std::uint32_t* to = found_.indices.data() + row * found_.size;
  if (inner_ == found_.size) {
    std::copy(index, index + count, to);
  } else {
    const double share = static_cast<double>(inner_) / static_cast<double>(found_.size);
    const Cut inner = find_cut(count, inner_, share * outer.squared, self);
    std::array<std::size_t, 2> at{inner_, 0};
    for (std::size_t j = 0; j < count; ++j) {
      const bool in =
          inner.is_clear() ? inner.takes(squared[j]) : inner.takes(squared[j], index[j]);
      to[at[in ? 1 : 0]++] = index[j];
    }
  }
  found_.reach[row] = std::sqrt(*std::max_element(squared, squared + count));
  return outer.squared;
}

}  // namespace

Neighborhoods find_neighborhoods(std::span<const Vec3> points, std::size_t size, int threads,
                                 std::size_t inner) {
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  return find_neighborhoods_of(all, points, size, threads, inner);
}

Neighborhoods find_neighborhoods_of(std::span<const std::uint32_t> of, std::span<const Vec3> points,
                                    std::size_t size, int threads, std::size_t inner) {
  Neighborhoods result;
  result.size = std::min(size, points.empty() ? 0 : points.size() - 1);
  result.indices.resize(of.size() * result.size);
  result.reach.resize(of.size());
  if (result.size == 0) return result;
  std::vector<std::uint32_t> row_of_point(points.size(), kNoIndex);
  for (std::uint32_t row = 0; row < of.size(); ++row) row_of_point[of[row]] = row;
  constexpr std::size_t kLeavesARow = 256;
  const double scale = unit_scale(largest_coordinate(points));
  const Tree tree(points, scale);
  const std::size_t rows = (tree.leaf_count() + kLeavesARow - 1) / kLeavesARow;
  parallel_rows(rows, threads, [&](std::size_t row) {
    Search search(tree, std::min(inner, result.size), row_of_point, result);
    const std::size_t end = std::min((row + 1) * kLeavesARow, tree.leaf_count());
    for (std::size_t leaf = row * kLeavesARow; leaf < end; ++leaf) {
      search.visit(tree.begin_of_leaf(leaf), tree.begin_of_leaf(leaf + 1));
    }
  });
  for (double& reach : result.reach) reach /= scale;
  return result;
}

std::vector<std::uint32_t> find_nearest(std::span<const Vec3> points, std::span<const Vec3> queries,
                                        int threads) {
  std::vector<std::uint32_t> nearest(queries.size());
  if (queries.empty()) return nearest;
  const PointTree tree(points);
  parallel_ranges(queries.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) nearest[i] = tree.nearest(queries[i]).index;
  });
  return nearest;
}

}  // namespace morsel
