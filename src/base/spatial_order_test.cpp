#include "base/spatial_order.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

using shapes::Points;

void expect_valid(const Points& input, const SpatialOrder& order) {
  ASSERT_EQ(order.order_of_point.size(), input.size());
  std::vector<bool> used(order.points.size(), false);
  for (std::size_t i = 0; i < input.size(); ++i) {
    ASSERT_LT(order.order_of_point[i], order.points.size());
    EXPECT_EQ(order.points[order.order_of_point[i]], input[i]) << i;
    used[order.order_of_point[i]] = true;
  }
  EXPECT_TRUE(std::ranges::all_of(used, [](bool u) { return u; }));
}

TEST(SpatialOrderTest, EmptyAndSingle) {
  EXPECT_TRUE(sort_spatially({}).points.empty());
  const Points one{{3, 4, 5}};
  expect_valid(one, sort_spatially(one));
}

TEST(SpatialOrderTest, FollowsTheMortonCurveOfACube) {
  // x is the highest bit, z the lowest.
  const SpatialOrder order = sort_spatially(shapes::grid(2));
  const Points expected{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1},
                        {1, 0, 0}, {1, 0, 1}, {1, 1, 0}, {1, 1, 1}};
  EXPECT_EQ(order.points, expected);
}

TEST(SpatialOrderTest, DoesNotDependOnTheOrderOfTheInput) {
  Points points = shapes::cube_cloud(5000);
  points.insert(points.end(), points.begin(), points.begin() + 100);
  const auto shuffle = shapes::permutation(points.size());
  const SpatialOrder order = sort_spatially(points);
  const SpatialOrder shuffled = sort_spatially(shapes::permuted(points, shuffle));
  EXPECT_EQ(order.points, shuffled.points);
  EXPECT_EQ(shapes::permuted(order.order_of_point, shuffle), shuffled.order_of_point);
}

TEST(SpatialOrderTest, KeepsRepeatedPointsOnce) {
  const Points points{{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {1, 2, 3}, {0, 0, 0}, {5, 5, 5}};
  const SpatialOrder order = sort_spatially(points);
  EXPECT_EQ(order.points.size(), 3U);
  expect_valid(points, order);
  EXPECT_EQ(order.order_of_point[0], order.order_of_point[2]);
  EXPECT_EQ(order.order_of_point[1], order.order_of_point[4]);
}

TEST(SpatialOrderTest, AllIdentical) {
  const Points points(50, {0.1, -7.0, 1e9});
  const SpatialOrder order = sort_spatially(points);
  EXPECT_EQ(order.points.size(), 1U);
  expect_valid(points, order);
}

TEST(SpatialOrderTest, NegativeZeroIsZero) {
  const Points points{{-0.0, 0.0, -0.0}, {0.0, -0.0, 0.0}, {1, 0, 0}};
  const SpatialOrder order = sort_spatially(points);
  ASSERT_EQ(order.points.size(), 2U);
  EXPECT_EQ(order.order_of_point[0], order.order_of_point[1]);
  for (const Vec3& p : order.points) {
    EXPECT_FALSE(std::signbit(p.x) || std::signbit(p.y) || std::signbit(p.z));
  }
}

TEST(SpatialOrderTest, ScalingByAPowerOfTwoKeepsTheOrder) {
  const Points points = shapes::cube_cloud(2000);
  const SpatialOrder order = sort_spatially(points);
  for (const int exponent : {-1000, -600, -60, -20, 20, 60, 600}) {
    const SpatialOrder other = sort_spatially(shapes::scaled(points, std::ldexp(1.0, exponent)));
    EXPECT_EQ(other.order_of_point, order.order_of_point) << "2^" << exponent;
  }
}

TEST(SpatialOrderTest, ExtremeCoordinatesStayDistinct) {
  constexpr double kMax = std::numeric_limits<double>::max();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  const Points huge{{kMax, 0, 0}, {-kMax, 0, 0}, {0, kMax, -kMax}, {1, 2, 3}, {kMax, 0, 0}};
  expect_valid(huge, sort_spatially(huge));
  EXPECT_EQ(sort_spatially(huge).points.size(), 4U);
  const Points tiny{{kLeast, 0, 0}, {0, 0, 0}, {0, kLeast, 0}, {0, 0, 0}};
  expect_valid(tiny, sort_spatially(tiny));
  EXPECT_EQ(sort_spatially(tiny).points.size(), 3U);
  const Points close{{1, 1, 1}, {1e12, 0, 0}, {std::nextafter(1.0, 2.0), 1, 1}, {1, 1, 1}};
  expect_valid(close, sort_spatially(close));
  EXPECT_EQ(sort_spatially(close).points.size(), 3U);
}

}  // namespace
}  // namespace morsel
