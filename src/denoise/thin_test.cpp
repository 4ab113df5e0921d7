#include "denoise/thin.hpp"

#include <gtest/gtest.h>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

TEST(UsefulPointsTest, FewerWhereNoiseIsWiderThanTheSpacing) {
  // The spacing of 200,000 points on the unit sphere is some 0.008.
  const shapes::Points points = shapes::sphere(200000);
  EXPECT_EQ(useful_points(points, 1), 200000U);
  EXPECT_EQ(useful_points(shapes::noisy(points, 0.004), 1), 200000U);
  const std::size_t some = useful_points(shapes::noisy(points, 0.03), 1);
  EXPECT_LE(some, 100000U);
  EXPECT_LT(useful_points(shapes::noisy(points, 0.1), 1), some);
  EXPECT_EQ(useful_points(shapes::noisy(points, 0.03), 2), some);
}

TEST(UsefulPointsTest, NoSurfaceAtAll) {
  EXPECT_LT(useful_points(shapes::cube_cloud(40000), 1), 2000U);
  EXPECT_EQ(useful_points(shapes::cube_cloud(1000), 1), 1000U);
  EXPECT_EQ(useful_points({}, 1), 0U);
}

}  // namespace
}  // namespace morsel
