#include "segment/pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "segment/test_stages.hpp"

namespace morsel {
namespace {

using shapes::Stages;

// Every basin a region of its own, all of them one object.
struct Grouping {
  std::vector<std::uint32_t> regions;
  std::vector<std::uint32_t> objects;
};

Grouping group(const Stages& s) {
  Grouping grouping;
  for (std::uint32_t b = 0; b < s.basins.count(); ++b) grouping.regions.push_back(b);
  grouping.objects.assign(s.basins.count(), 0);
  return grouping;
}

// Growth by the book: E. W. Dijkstra's algorithm for the way that strays least.
class Reference {
 public:
  explicit Reference(const Stages& s)
      : s_(s),
        distance_(s.complex.cell_count(), std::numeric_limits<double>::infinity()),
        piece_(s.complex.cell_count(), kNoBasin) {}

  void add(std::uint32_t seed, std::uint32_t piece) {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const Vec3 center = cell_centroid(s_.complex, seed);
    const auto reach = [&](std::uint32_t c, double distance) {
      distance_[c] = distance;
      piece_[c] = piece;
      queue.emplace(distance, c);
    };
    reach(seed, 0.0);
    while (!queue.empty()) {
      const auto [reached, c] = queue.top();
      queue.pop();
      if (reached > distance_[c]) continue;
      for (const std::uint32_t d : s_.complex.neighbors[c]) {
        if (d == kNoCell || s_.basins.basin_of_cell[d] != s_.basins.basin_of_cell[seed]) continue;
        const double next = std::max(reached, distance(center, cell_centroid(s_.complex, d)));
        if (next < distance_[d]) reach(d, next);
      }
    }
  }

  [[nodiscard]] double distance_of(std::uint32_t cell) const { return distance_[cell]; }
  [[nodiscard]] const std::vector<std::uint32_t>& pieces() const { return piece_; }

 private:
  const Stages& s_;
  std::vector<double> distance_;
  std::vector<std::uint32_t> piece_;
};

Pieces split(const Stages& s, int threads) {
  const Grouping grouping = group(s);
  constexpr double kSpacing = 0.1;
  Pieces told;
  Pieces pieces = split_regions(s.complex, s.basins, grouping.regions, grouping.objects, kSpacing,
                                threads, [&](std::uint32_t seed, double extent) {
                                  told.seed.push_back(seed);
                                  told.extent.push_back(extent);
                                });
  EXPECT_EQ(told.seed, pieces.seed);
  EXPECT_EQ(told.extent, pieces.extent);
  return pieces;
}

TEST(PiecesTest, AreVoronoiRegionsOfSeedsChosenFarthestFirst) {
  const Stages s = shapes::run_stages(shapes::noisy(shapes::torus(2500, 2.0, 0.6), 0.01));
  const Pieces pieces = split(s, 2);
  ASSERT_GT(pieces.count(), s.basins.count());
  Reference reference(s);
  for (std::uint32_t p = 0; p < pieces.count(); ++p) {
    if (p >= s.basins.count()) {
      double farthest = 0.0;
      for (std::uint32_t c = 0; c < s.complex.cell_count(); ++c) {
        const bool may_seed = reference.pieces()[c] != kNoBasin && s.complex.radii[c] > 0.12;
        if (may_seed) farthest = std::max(farthest, reference.distance_of(c));
      }
      EXPECT_NEAR(reference.distance_of(pieces.seed[p]), farthest, 1e-9 * farthest);
    }
    reference.add(pieces.seed[p], p);
  }
  EXPECT_EQ(pieces.piece_of_cell, reference.pieces());
}

TEST(PiecesTest, ThreadsChangeNothing) {
  const Stages s = shapes::run_stages(shapes::dumbbell(4000));
  EXPECT_EQ(split(s, 1).piece_of_cell, split(s, 2).piece_of_cell);
  EXPECT_EQ(split(s, 1).seed, split(s, 2).seed);
}

}  // namespace
}  // namespace morsel
