#include "solids/solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace morsel::solids {
namespace {

Solid ball(double radius = 1.0) { return {{.body = Limb{{}, {}, radius, radius}}}; }

void expect_stretch(const Body& body, const Vec3& origin, const Vec3& direction, double enter,
                    double leave) {
  const auto stretch = stretch_inside(body, origin, direction);
  ASSERT_TRUE(stretch.has_value());
  EXPECT_NEAR(stretch->enter, enter, 1e-12);
  EXPECT_NEAR(stretch->leave, leave, 1e-12);
}

TEST(StretchInside, OfEachBody) {
  const Vec3 x{1, 0, 0};
  const Vec3 z{0, 0, 1};
  expect_stretch(Limb{{0, 0, 0}, {2, 0, 0}, 1.0, 1.0}, {0, 0, 0}, x, -1.0, 3.0);
  expect_stretch(Limb{{0, 0, 0}, {2, 0, 0}, 1.0, 1.0}, {1, 0, 0}, z, -1.0, 1.0);
  // A cone that touches balls of radius 2 and 1 at distance 2: sine 1/2.
  expect_stretch(Limb{{0, 0, 0}, {2, 0, 0}, 2.0, 1.0}, {1.25, 0, 0}, z, -2.75 / std::sqrt(3.0),
                 2.75 / std::sqrt(3.0));
  expect_stretch(Frustum{{0, 0, 0}, {0, 0, 2}, 1.0, 3.0}, {0, 0, 1}, x, -2.0, 2.0);
  expect_stretch(Frustum{{0, 0, 0}, {0, 0, 2}, 1.0, 3.0}, {0, 0, 0}, z, 0.0, 2.0);
  expect_stretch(Frustum{{0, 0, 0}, {0, 0, 2}, 1.0, 3.0}, {2, 0, 0}, z, 1.0, 2.0);
  expect_stretch(Ellipsoid{{0, 0, 0}, {1, 2, 3}}, {0, 0, 0}, z, -3.0, 3.0);
  expect_stretch(Block{{0, 0, 0}, {1, 2, 3}}, {0.5, 0.5, 0}, z, -3.0, 3.0);
  EXPECT_FALSE(stretch_inside(Block{{0, 0, 0}, {1, 2, 3}}, {1.5, 0.5, 0}, z).has_value());
  EXPECT_FALSE(stretch_inside(Limb{{0, 0, 0}, {2, 0, 0}, 1.0, 1.0}, {0, 2, 0}, x).has_value());
}

TEST(Sample, IsOnTheSurfaceAndTheSameForTheSameSeed) {
  const LabelledPoints cloud = sample(ball(), {.count = 3000});
  ASSERT_EQ(cloud.points.size(), 3000U);
  ASSERT_EQ(cloud.parts.size(), 3000U);
  for (const Vec3& p : cloud.points) EXPECT_NEAR(norm(p), 1.0, 1e-12);
  EXPECT_EQ(cloud.points, sample(ball(), {.count = 3000}).points);
  EXPECT_NE(cloud.points, sample(ball(), {.count = 3000, .seed = 2}).points);
}

TEST(Sample, IsUniform) {
  // Side and ends of this capsule have the areas 4π and 4π.
  const Solid capsule{{.body = Limb{{0, 0, 0}, {2, 0, 0}, 1.0, 1.0}}};
  const LabelledPoints cloud = sample(capsule, {.count = 20000});
  const auto on_side =
      std::ranges::count_if(cloud.points, [](const Vec3& p) { return p.x > 0.0 && p.x < 2.0; });
  EXPECT_NEAR(static_cast<double>(on_side), 10000.0, 400.0);
}

TEST(Sample, KnowsTheParts) {
  // A cube with a stud on its top.
  const Solid solid{{.body = Block{{0, 0, 0}, {1, 1, 1}}, .part = 0},
                    {.body = Frustum{{0, 0, 0.5}, {0, 0, 2}, 0.5, 0.5}, .part = 1}};
  const LabelledPoints cloud = sample(solid, {.count = 5000});
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3& p = cloud.points[i];
    EXPECT_EQ(cloud.parts[i], p.z > 1.0 + 1e-9 ? 1 : 0);
    if (cloud.parts[i] == 0 && p.z > 1.0 - 1e-9) {
      EXPECT_GE(std::hypot(p.x, p.y), 0.5 - 1e-9);
    }
  }
}

TEST(Sample, HolesHaveWallsOfThePartAroundThem) {
  const Solid solid{{.body = Block{{0, 0, 0}, {1, 1, 1}}, .part = 3},
                    {.body = Frustum{{0, 0, -2}, {0, 0, 2}, 0.5, 0.5}, .part = 9, .hole = true}};
  const LabelledPoints cloud = sample(solid, {.count = 20000});
  std::size_t on_wall = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const double off = std::hypot(cloud.points[i].x, cloud.points[i].y);
    EXPECT_EQ(cloud.parts[i], 3);
    EXPECT_GE(off, 0.5 - 1e-9);
    EXPECT_LE(std::abs(cloud.points[i].z), 1.0 + 1e-9);
    if (off < 0.5 + 1e-9) ++on_wall;
  }
  // The wall 2π, all 24 - π/2 + 2π.
  EXPECT_NEAR(static_cast<double>(on_wall) / 20000.0, 0.2189, 0.015);
}

TEST(Sample, HasNoiseOfTheGivenSize) {
  const LabelledPoints cloud = sample(ball(), {.count = 20000, .noise = 0.01});
  double sum = 0.0;
  for (const Vec3& p : cloud.points) sum += (norm(p) - 1.0) * (norm(p) - 1.0);
  EXPECT_NEAR(std::sqrt(sum / 20000.0), 0.01 * std::sqrt(12.0), 2e-3);
}

TEST(Bend, MovesPointsALittleAndMakesACylinderUneven) {
  const Solid capsule{{.body = Limb{{-2, 0, 0}, {2, 0, 0}, 0.5, 0.5}}};
  const auto points = sample(capsule, {.count = 1000}).points;
  auto bent = points;
  bend(bent);
  double least = 1.0;
  double most = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(distance(points[i], bent[i]), 0.11);
    const double from_axis = std::hypot(bent[i].y, bent[i].z);
    least = std::min(least, from_axis);
    most = std::max(most, from_axis);
  }
  EXPECT_GT(most, least + 0.05);
}

}  // namespace
}  // namespace morsel::solids
