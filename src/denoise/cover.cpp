#include "denoise/cover.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "base/cancel.hpp"
#include "base/neighbor_search.hpp"
#include "base/quantile.hpp"

namespace morsel {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Of uniformly random points on a plane 1 / (1 + kCovered · m) are kept, measured, if discs of the
// radius within which none is kept hold m on average.
constexpr double kCovered = 0.42;
// So many neighbourhoods tell how far others lie.
constexpr std::size_t kSounded = 256;

// Over the 90% quantile of the reaches of the cloud, and over the reaches of the neighbours.
constexpr double kFromCloud = 3.0;
constexpr double kFromNeighbors = 1.6;

// By their distance from the middle of all.
std::vector<std::uint32_t> from_far_to_near(std::span<const Vec3> points) {
  Vec3 mean;
  for (const Vec3& p : points) mean = mean + (1.0 / static_cast<double>(points.size())) * p;
  std::vector<std::pair<double, std::uint32_t>> order;
  order.reserve(points.size());
  for (const Vec3& p : points) {
    order.emplace_back(-squared_distance(p, mean), static_cast<std::uint32_t>(order.size()));
  }
  std::ranges::sort(order);
  std::vector<std::uint32_t> indices;
  indices.reserve(order.size());
  for (const auto& entry : order) indices.push_back(entry.second);
  return indices;
}

class Covering {
 public:
  Covering(std::span<const Vec3> points, std::size_t most, std::size_t size, int threads)
      : points_(points),
        by_(points.size(), kNone),
        squared_(points.size(), kInfinity),
        is_outlier_(points.size(), false) {
    found_.size = std::min(size, points.empty() ? 0 : points.size() - 1);
    const bool all = points.size() <= most;
    if (all) {
      keep_all(threads);
    } else {
      search_.emplace(points_);
      order_ = from_far_to_near(points_);
      const double beyond = static_cast<double>(points.size()) / static_cast<double>(most) - 1.0;
      share_ = share_of_reach(beyond / kCovered);
      keep_evenly();
    }
    far_ = kFromCloud * quantile(found_.reach, 0.9);
    // What stood in the shade of an outlier is looked at again.
    bool shaded = drop_outliers(0) && !all;
    while (shaded) {
      const std::size_t judged = kept_.size();
      keep_evenly();
      shaded = drop_outliers(judged);
    }
  }

  [[nodiscard]] Cover result(int threads) const;

 private:
  void keep_all(int threads) {
    kept_.resize(points_.size());
    std::iota(kept_.begin(), kept_.end(), 0);
    by_ = kept_;
    found_ = find_neighborhoods(points_, found_.size, threads);
  }

  // The squared distance within which `count` others lie on average, in squared reaches: on a
  // surface count / size, more where neighbourhoods are as thick as the noise.
  [[nodiscard]] double share_of_reach(double count) const {
    const std::size_t size = found_.size;
    const double on_surface = count / static_cast<double>(std::max<std::size_t>(size, 1));
    const auto whole = static_cast<std::size_t>(count);
    if (whole >= size) return on_surface;
    const std::size_t sounded = std::min(order_.size(), kSounded);
    std::vector<std::uint32_t> row(size);
    double sum = 0.0;
    for (std::size_t k = 0; k < sounded; ++k) {
      const std::uint32_t i = order_[k * order_.size() / sounded];
      const double reach = search_->find(i, row);
      const auto to = [&](std::size_t rank) {
        return rank == 0 ? 0.0 : squared_distance(points_[i], points_[row[rank - 1]]);
      };
      sum += std::lerp(to(whole), to(whole + 1), count - std::floor(count)) / (reach * reach);
    }
    // Squares may overflow or vanish.
    return std::isfinite(sum) ? sum / static_cast<double>(sounded) : on_surface;
  }

  // Keeps what is not covered yet, from the outside to the middle: in another pose the same points.
  void keep_evenly() {
    for (const std::uint32_t i : order_) {
      if (by_[i] == kNone && !is_outlier_[i]) keep(i);
    }
  }

  void keep(std::uint32_t i) {
    if (kept_.size() % 1024 == 0) check_cancelled();
    const auto own = static_cast<std::uint32_t>(kept_.size());
    kept_.push_back(i);
    by_[i] = own;
    squared_[i] = 0.0;
    found_.indices.resize(kept_.size() * found_.size);
    const auto row = std::span(found_.indices).last(found_.size);
    const double reach = search_->find(i, row);
    found_.reach.push_back(reach);
    for (const std::uint32_t j : row) {
      const double squared = squared_distance(points_[i], points_[j]);
      if (squared >= (by_[j] != kNone ? squared_[j] : share_ * reach * reach)) continue;
      squared_[j] = squared;
      by_[j] = own;
    }
  }

  // Of those kept from the place `first` on; false if there are none.
  bool drop_outliers(std::size_t first) {
    const std::vector<double>& reach = found_.reach;
    const std::size_t half = std::max<std::size_t>((found_.size + 1) / 2, 1);
    std::vector<bool> drop(kept_.size(), false);
    bool any = false;
    for (std::size_t row = first; row < kept_.size(); ++row) {
      // The median reach of the neighbours is so small if half of them are.
      const auto small = std::ranges::count_if(found_.of(row), [&](std::uint32_t j) {
        return by_[j] != kNone && kFromNeighbors * reach[by_[j]] < reach[row];
      });
      drop[row] = reach[row] > far_ || static_cast<std::size_t>(small) >= half;
      if (!drop[row]) continue;
      is_outlier_[kept_[row]] = true;
      any = true;
    }
    for (std::size_t i = 0; any && i < points_.size(); ++i) {
      if (by_[i] == kNone || !drop[by_[i]]) continue;
      by_[i] = kNone;
      squared_[i] = kInfinity;
    }
    return any;
  }

  std::span<const Vec3> points_;
  std::optional<NeighborSearch> search_;
  std::vector<std::uint32_t> order_;
  double share_ = 0.0;  // of the squared reach: within it what is near is covered
  double far_ = 0.0;
  std::vector<std::uint32_t> kept_;  // in the order in which they were found, outliers too
  Neighborhoods found_;              // of those
  std::vector<std::uint32_t> by_;    // place in kept_
  std::vector<double> squared_;      // distance to that
  std::vector<bool> is_outlier_;
};

// What stands for each outlier: the nearest of all that are kept.
void find_stand_ins(std::span<const Vec3> points, const std::vector<std::uint32_t>& outliers,
                    const std::vector<Vec3>& kept, int threads,
                    std::vector<std::uint32_t>& stand_in) {
  std::vector<Vec3> queries;
  queries.reserve(outliers.size());
  for (const std::uint32_t i : outliers) queries.push_back(points[i]);
  const std::vector<std::uint32_t> nearest = find_nearest(kept, queries, threads);
  for (std::size_t k = 0; k < outliers.size(); ++k) stand_in[outliers[k]] = nearest[k];
}

Cover Covering::result(int threads) const {
  Cover cover;
  cover.far = far_;
  cover.is_outlier = is_outlier_;
  std::vector<std::uint32_t> place(points_.size(), kNone);  // in cover.points
  std::vector<std::uint32_t> outliers;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    if (is_outlier_[i]) {
      outliers.push_back(i);
      continue;
    }
    place[i] = static_cast<std::uint32_t>(cover.points.size());
    cover.points.push_back(points_[i]);
  }
  std::vector<std::uint32_t> rows;
  for (std::uint32_t row = 0; row < kept_.size(); ++row) {
    if (!is_outlier_[kept_[row]]) rows.push_back(row);
  }
  std::ranges::sort(rows, {}, [&](std::uint32_t row) { return kept_[row]; });
  std::vector<std::uint32_t> place_of_row(kept_.size(), kNone);  // in cover.kept
  cover.neighborhoods.size = found_.size;
  for (const std::uint32_t row : rows) {
    const std::uint32_t i = kept_[row];
    place_of_row[row] = static_cast<std::uint32_t>(cover.kept.size());
    cover.kept.push_back(place[i]);
    cover.neighborhoods.reach.push_back(found_.reach[row]);
    for (const std::uint32_t j : found_.of(row)) {
      cover.neighborhoods.indices.push_back(place[is_outlier_[j] ? i : j]);
    }
  }
  cover.stand_in.assign(points_.size(), 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (is_outlier_[i]) continue;
    cover.stand_in[i] = place_of_row[by_[i]];
    cover.by.push_back(cover.stand_in[i]);
  }
  if (!outliers.empty()) {
    find_stand_ins(points_, outliers, cover.kept_points(), threads, cover.stand_in);
  }
  return cover;
}

}  // namespace

Cover cover_cloud(std::span<const Vec3> points, std::size_t most, std::size_t size, int threads) {
  return Covering(points, most, size, threads).result(threads);
}

}  // namespace morsel
