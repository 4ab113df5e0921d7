#include "base/neighborhoods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <morsel/error.hpp>
#include <set>
#include <utility>

#include "base/cancel.hpp"
#include "base/test_shapes.hpp"

namespace morsel {
namespace {

using shapes::Points;

// The nearest others, of equally near ones those with smaller indices.
std::vector<std::uint32_t> brute_force(const Points& points, std::size_t i, std::size_t size) {
  std::vector<std::pair<double, std::uint32_t>> others;
  for (std::uint32_t j = 0; j < points.size(); ++j) {
    if (j != i) others.emplace_back(squared_distance(points[i], points[j]), j);
  }
  std::ranges::sort(others);
  std::vector<std::uint32_t> nearest;
  for (std::size_t k = 0; k < std::min(size, others.size()); ++k) {
    nearest.push_back(others[k].second);
  }
  return nearest;
}

template <typename Range>
std::set<std::uint32_t> as_set(const Range& range) {
  return {range.begin(), range.end()};
}

void expect_as_brute_force(const Points& points, std::size_t size, std::size_t inner) {
  const Neighborhoods found = find_neighborhoods(points, size, 1, inner);
  ASSERT_EQ(found.size, std::min(size, points.size() - 1));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<std::uint32_t> expected = brute_force(points, i, size);
    EXPECT_EQ(as_set(found.of(i)), as_set(expected)) << i;
    const std::size_t front = std::min(inner, found.size);
    EXPECT_EQ(as_set(found.of(i).first(front)), as_set(brute_force(points, i, inner))) << i;
    EXPECT_EQ(found.reach[i], distance(points[i], points[expected.back()])) << i;
  }
  EXPECT_EQ(find_neighborhoods(points, size, 2, inner).indices, found.indices);
}

TEST(NeighborhoodsTest, Cloud) {
  expect_as_brute_force(shapes::cube_cloud(1500), 12, 12);
  expect_as_brute_force(shapes::cube_cloud(1500), 40, 24);
}

TEST(NeighborhoodsTest, Surface) {
  expect_as_brute_force(shapes::noisy(shapes::torus(1500, 2.0, 0.5), 0.01), 40, 24);
  expect_as_brute_force(shapes::torus(1500, 2.0, 0.5), 3, 1);
}

// Every distance occurs many times.
TEST(NeighborhoodsTest, Grid) {
  expect_as_brute_force(shapes::grid(9), 12, 5);
  expect_as_brute_force(shapes::grid(9), 6, 6);
}

TEST(NeighborhoodsTest, ClustersAndStrays) {
  Points points;
  Random random(2);
  for (int cluster = 0; cluster < 30; ++cluster) {
    const Vec3 center = 100.0 * shapes::random_in_cube(random);
    const double size = std::pow(10.0, -6.0 * random.uniform());
    for (int i = 0; i < 1 + cluster * 3; ++i) {
      points.push_back(center + size * shapes::random_in_cube(random));
    }
  }
  points.push_back({1e9, 0.0, 0.0});
  expect_as_brute_force(points, 12, 4);
}

TEST(NeighborhoodsTest, Line) {
  Points points;
  for (int i = 0; i < 300; ++i) points.push_back({0.001 * i * i, 0.0, 0.0});
  expect_as_brute_force(points, 7, 3);
}

TEST(NeighborhoodsTest, FewerPointsThanAskedFor) {
  EXPECT_EQ(find_neighborhoods({}, 5, 1).size, 0U);
  EXPECT_EQ(find_neighborhoods(Points{{1.0, 2.0, 3.0}}, 5, 1).size, 0U);
  for (std::size_t count = 2; count < 30; ++count) {
    expect_as_brute_force(shapes::cube_cloud(count), 24, 12);
  }
}

// Where squares of coordinates would overflow or vanish.
TEST(NeighborhoodsTest, DoNotDependOnTheScale) {
  const Points points = shapes::cube_cloud(200);
  const Neighborhoods usual = find_neighborhoods(points, 5, 1, 2);
  for (const int exponent : {1000, 300, -300, -500, -540, -1000}) {
    Points scaled = points;
    for (Vec3& p : scaled) p = std::ldexp(1.0, exponent) * p;
    const Neighborhoods found = find_neighborhoods(scaled, 5, 1, 2);
    EXPECT_EQ(found.indices, usual.indices) << exponent;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(found.reach[i], std::ldexp(usual.reach[i], exponent));
    }
  }
}

// Half of the points lie so near together that their squared distances lose digits, or vanish.
TEST(NeighborhoodsTest, FineClusters) {
  for (const double scale : {1e-155, 1e-158, 1e-160, 1e-161, 1e-162, 1e-170, 1e-300}) {
    Points points = shapes::cube_cloud(200);
    for (std::size_t i = 0; i < points.size(); i += 2) points[i] = scale * points[i];
    const Neighborhoods found = find_neighborhoods(points, 5, 1, 2);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto distinct = as_set(found.of(i));
      EXPECT_EQ(distinct.size(), 5U);
      EXPECT_FALSE(distinct.contains(static_cast<std::uint32_t>(i)));
      EXPECT_LT(*distinct.rbegin(), points.size());
    }
  }
}

// A point is no neighbour of its own where all distances vanish, nor takes the place of another's.
TEST(NeighborhoodsTest, VanishingDistances) {
  Points points = shapes::cube_cloud(100);
  for (Vec3& p : points) p = 1e-200 * p;
  points.insert(points.begin(), {1.0, 0.0, 0.0});
  const Neighborhoods found = find_neighborhoods(points, 5, 1, 2);
  ASSERT_EQ(found.indices.size(), 5 * points.size());
  for (std::uint32_t i = 1; i < points.size(); ++i) {
    std::set<std::uint32_t> expected{1, 2, 3, 4, 5};
    if (expected.erase(i) > 0) expected.insert(6);
    EXPECT_EQ(as_set(found.of(i)), expected) << i;
  }
}

TEST(NeighborhoodsTest, CanBeCancelled) {
  Progress progress;
  progress.cancel();
  const CancelScope scope(&progress);
  EXPECT_THROW((void)find_neighborhoods(shapes::cube_cloud(500), 5, 1), Error);
}

TEST(NeighborhoodsTest, NearestOfAnotherCloud) {
  const Points points = shapes::cube_cloud(300);
  const Points queries = shapes::cube_cloud(200, 7);
  const std::vector<std::uint32_t> found = find_nearest(points, queries, 2);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    for (const Vec3& p : points) {
      EXPECT_LE(distance(queries[i], points[found[i]]), distance(queries[i], p));
    }
  }
  EXPECT_TRUE(find_nearest(points, {}, 1).empty());
}

TEST(NeighborhoodsTest, SomeAreFoundAsAllAre) {
  const Points points = shapes::sphere(3000);
  std::vector<std::uint32_t> of;
  for (std::uint32_t i = 0; i < points.size(); i += 7) of.push_back(i);
  const Neighborhoods all = find_neighborhoods(points, 20, 1, 8);
  const Neighborhoods some = find_neighborhoods_of(of, points, 20, 2, 8);
  ASSERT_EQ(some.size, 20U);
  ASSERT_EQ(some.reach.size(), of.size());
  for (std::size_t k = 0; k < of.size(); ++k) {
    const auto found = some.of(k);
    const auto expected = all.of(of[k]);
    EXPECT_TRUE(std::ranges::is_permutation(found, expected)) << k;
    EXPECT_EQ(some.reach[k], all.reach[of[k]]);
    EXPECT_TRUE(std::ranges::is_permutation(found.first(8), expected.first(8))) << k;
  }
}

TEST(NeighborhoodsTest, SomeOfFewPoints) {
  const Points points = shapes::cube_cloud(5);
  EXPECT_EQ(find_neighborhoods_of(std::vector<std::uint32_t>{2}, points, 20, 1, 20).size, 4U);
  EXPECT_EQ(find_neighborhoods_of({}, {}, 20, 1, 20).size, 0U);
}

}  // namespace
}  // namespace morsel
