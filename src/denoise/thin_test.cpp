#include "denoise/thin.hpp"

#include <gtest/gtest.h>

#include "base/spatial_order.hpp"
#include "base/test_shapes.hpp"

namespace morsel {
namespace {

std::size_t useful(const shapes::Points& points, int threads = 1) {
  return useful_points(sort_spatially(points).points, threads);
}

TEST(UsefulPointsTest, FewerWhereNoiseIsWiderThanTheSpacing) {
  // The spacing of 200,000 points on the unit sphere is some 0.008.
  const shapes::Points points = shapes::sphere(200000);
  EXPECT_EQ(useful(points), 200000U);
  EXPECT_EQ(useful(shapes::noisy(points, 0.004)), 200000U);
  const std::size_t some = useful(shapes::noisy(points, 0.03));
  EXPECT_LE(some, 100000U);
  EXPECT_LT(useful(shapes::noisy(points, 0.1)), some);
  EXPECT_EQ(useful(shapes::noisy(points, 0.03), 2), some);
}

TEST(UsefulPointsTest, NoSurfaceAtAll) {
  EXPECT_LT(useful(shapes::cube_cloud(40000)), 2000U);
  EXPECT_EQ(useful(shapes::cube_cloud(1000)), 1000U);
  EXPECT_EQ(useful_points({}, 1), 0U);
}

}  // namespace
}  // namespace morsel
