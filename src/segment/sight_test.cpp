#include "segment/sight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "delaunay/balls.hpp"
#include "segment/test_stages.hpp"

namespace morsel {
namespace {

using shapes::Stages;

// The share of a segment that lies in one cell: what its four planes leave of it.
double share_in_cell(const DelaunayComplex& complex, std::size_t cell, const Vec3& start,
                     const Vec3& way) {
  double enter = 0.0;
  double leave = 1.0;
  for (const auto& slots : kFacetSlots) {
    const auto corner = [&](std::size_t k) {
      return complex.vertices[complex.cells[cell][static_cast<std::size_t>(slots[k])]];
    };
    const Vec3 normal = cross(corner(1) - corner(0), corner(2) - corner(0));
    const double depth = dot(normal, corner(0) - start);
    const double speed = dot(normal, way);
    if (speed > 0.0) leave = std::min(leave, depth / speed);
    if (speed < 0.0) enter = std::max(enter, depth / speed);
    if (speed == 0.0 && depth < 0.0) return 0.0;
  }
  return std::max(leave - enter, 0.0);
}

// How far the segment between two cells runs outside, over all cells there are.
double length_outside(const Stages& s, std::uint32_t from, std::uint32_t to) {
  const Vec3 start = cell_centroid(s.complex, from);
  const Vec3 way = cell_centroid(s.complex, to) - start;
  double inside = 0.0;
  for (std::size_t c = 0; c < s.complex.cell_count(); ++c) {
    if (s.interior.side[c] == CellSide::kInner) inside += share_in_cell(s.complex, c, start, way);
  }
  return (1.0 - inside) * norm(way);
}

SightTable look_around(const Stages& s, const std::vector<std::uint32_t>& seeds, double extent,
                       double spacing, int threads) {
  SightSearch search(s.complex, s.interior, spacing, threads);
  for (const std::uint32_t seed : seeds) search.add(seed, extent);
  return search.table();
}

TEST(SightTest, SegmentsStayInsideWhereTheirCellsSaySo) {
  const Stages s = shapes::run_stages(shapes::noisy(shapes::torus(1500, 2.0, 0.7), 0.01));
  std::vector<std::uint32_t> seeds;
  for (std::uint32_t c = 0; c < s.complex.cell_count(); c += 97) {
    if (s.interior.side[c] == CellSide::kInner) seeds.push_back(c);
  }
  constexpr double kExtent = 100.0;  // every pair is near enough to be looked at
  constexpr double kSpacing = 0.1;
  const SightTable table = look_around(s, seeds, kExtent, kSpacing, 2);
  std::size_t seen = 0;
  std::size_t pairs = 0;
  for (std::size_t a = 0; a < seeds.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double outside = length_outside(s, seeds[a], seeds[b]);
      if (std::abs(outside - 0.5 * kSpacing) < 1e-6) continue;  // rounding decides
      const float found = table.seen[a * seeds.size() + b];
      EXPECT_EQ(found != 0.0F, outside < 0.5 * kSpacing) << a << " " << b << " " << outside;
      EXPECT_EQ(found, table.seen[b * seeds.size() + a]);
      seen += found != 0.0F ? 1 : 0;
      ++pairs;
    }
  }
  EXPECT_GT(seen, 50U);
  EXPECT_GT(pairs - seen, 50U);
}

TEST(SightTest, FarPairsDoNotCount) {
  const Stages s = shapes::run_stages(shapes::noisy(shapes::torus(1500, 2.0, 0.7), 0.01));
  const std::vector<std::uint32_t> seeds{s.basins.maximum.front(), s.basins.maximum.back()};
  const double apart =
      distance(cell_centroid(s.complex, seeds[0]), cell_centroid(s.complex, seeds[1]));
  const SightTable table = look_around(s, seeds, apart / 1.1, 0.1, 1);
  EXPECT_EQ(table.weight[1], 0.0F);
  EXPECT_EQ(table.weight[0], 1.0F);
}

TEST(SightTest, OfPairsInBetweenEverySecondCountsForTwo) {
  const Stages s = shapes::run_stages(shapes::sphere(3000));
  constexpr double kExtent = 2.0;
  std::vector<std::uint32_t> seeds;
  for (std::size_t k = 0; k < 40; ++k) {
    seeds.push_back(static_cast<std::uint32_t>(k * s.complex.cell_count() / 40));
  }
  const SightTable table = look_around(s, seeds, kExtent, 0.1, 1);
  std::size_t doubled = 0;
  for (std::size_t a = 0; a < seeds.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double apart =
          distance(cell_centroid(s.complex, seeds[a]), cell_centroid(s.complex, seeds[b]));
      const double scaled = apart / (0.65 * kExtent);
      double times = 1.0;
      if (apart >= 0.6 * kExtent) times = (a + b) % 2 == 0 ? 2.0 : 0.0;
      if (apart >= 0.85 * kExtent) times = 0.0;
      doubled += times > 1.0 ? 1 : 0;
      EXPECT_NEAR(table.weight[a * seeds.size() + b], times * std::exp(-scaled * scaled), 1e-6);
    }
  }
  EXPECT_GT(doubled, 50U);
}

// Cells of a grid are flat or share spheres, and lines between them run along edges and through
// corners: walks could turn in circles there.
TEST(SightTest, RegularGridsAreSeenThrough) {
  Stages s;
  s.complex = triangulate(shapes::grid(7));
  s.interior.side.assign(s.complex.cell_count(), CellSide::kInner);
  std::vector<std::uint32_t> seeds;
  for (std::uint32_t c = 0; c < s.complex.cell_count(); c += 5) seeds.push_back(c);
  const SightTable table = look_around(s, seeds, 1000.0, 1.0, 2);
  EXPECT_TRUE(std::ranges::all_of(table.seen, [](float seen) { return seen == 1.0F; }));
}

}  // namespace
}  // namespace morsel
