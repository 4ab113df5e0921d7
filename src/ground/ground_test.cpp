#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <morsel/error.hpp>
#include <morsel/ground.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

using shapes::Points;

// A square plane z = 0 of this side about the origin.
Points plane(std::size_t count, double side, std::uint64_t seed = 3) {
  return shapes::changed(shapes::cube_cloud(count, seed), [&](const Vec3& p) {
    return Vec3{side * (p.x - 0.5), side * (p.y - 0.5), 0.0};
  });
}

// Stands on z = 0 in the middle; its lower face is missing.
Points open_box(std::size_t count, const Vec3& size) {
  Points points = shapes::moved(shapes::box(count, size), {-0.5 * size.x, -0.5 * size.y, 0.0});
  std::erase_if(points, [](const Vec3& p) { return p.z == 0.0; });
  return points;
}

// The plane around it, not under it.
Points scanned_box(double side, double noise) {
  const Vec3 size{1.0, 1.4, 0.8};
  Points around = plane(static_cast<std::size_t>(1500.0 * side * side), side);
  std::erase_if(around, [](const Vec3& p) { return std::abs(p.x) < 0.52 && std::abs(p.y) < 0.72; });
  return shapes::noisy(shapes::joined(open_box(8000, size), around), noise);
}

std::size_t count_apart(const Ground& ground) {
  return static_cast<std::size_t>(std::ranges::count(ground.apart, char{1}));
}

TEST(GroundTest, FindsThePlaneUnderABox) {
  for (const double side : {2.2, 4.0, 7.0}) {
    for (const double noise : {0.0, 0.005, 0.01}) {
      const Points points = shapes::turned(scanned_box(side, noise), shapes::rotation());
      const Ground ground = find_ground(points);
      ASSERT_TRUE(ground.plane) << side << " " << noise;
      const auto rows = shapes::rotation();
      const Vec3 up{rows[0].z, rows[1].z, rows[2].z};
      EXPECT_GT(dot(ground.plane->normal, up), std::cos(0.01));
      EXPECT_NEAR(ground.plane->offset, 0.0, 0.01);
      EXPECT_LT(ground.plane->thickness, 6.0 * noise + 1e-3);
    }
  }
}

TEST(GroundTest, SetsThePlaneApartAndClosesTheBox) {
  const Points points = scanned_box(4.0, 0.0);
  const Ground ground = find_ground(points);
  ASSERT_TRUE(ground.plane);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    const bool far = std::abs(p.x) > 0.6 || std::abs(p.y) > 0.8;
    if (p.z > 0.01) {
      EXPECT_EQ(ground.apart[i], 0);
    }
    if (p.z == 0.0 && far) {
      EXPECT_EQ(ground.apart[i], 1);
    }
  }
  // As dense as the box, 8000 samples on its 6.64 units of surface, and only beneath it.
  EXPECT_NEAR(static_cast<double>(ground.base.size()), 1.4 * 8000.0 / 6.64, 400.0);
  for (const Vec3& p : ground.base) {
    EXPECT_NEAR(p.z, 0.0, 1e-9);
    EXPECT_LT(std::abs(p.x), 0.6);
    EXPECT_LT(std::abs(p.y), 0.8);
  }
}

TEST(GroundTest, PointsOfThePlaneBeneathABoxAreItsBase) {
  const Points points = shapes::joined(open_box(8000, {1, 1, 1}), plane(20000, 4.0));
  const Ground ground = find_ground(points);
  ASSERT_TRUE(ground.plane);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(points[i].x) < 0.45 && std::abs(points[i].y) < 0.45) {
      EXPECT_EQ(ground.apart[i], 0);
    }
  }
}

TEST(GroundTest, CrumbsAreOfTheGround) {
  const Points crumbs = shapes::changed(shapes::cube_cloud(6), [](const Vec3& p) {
    return Vec3{1.5 + 0.02 * p.x, 1.5 + 0.02 * p.y, 0.001 + 0.02 * p.z};
  });
  const Points points = shapes::joined(scanned_box(4.0, 0.0), crumbs);
  const Ground ground = find_ground(points);
  ASSERT_TRUE(ground.plane);
  for (std::size_t i = points.size() - crumbs.size(); i < points.size(); ++i) {
    EXPECT_EQ(ground.apart[i], 1);
  }
}

// --- what is no ground ------------------------------------------------------------------------

// A plate of this thickness with a pin standing in its middle.
Points pin_on_plate(double thickness, double noise) {
  const Points plate = shapes::moved(shapes::box(12000, {4, 4, thickness}), {-2, -2, -thickness});
  const Points pin = shapes::moved(shapes::box(4000, {0.4, 0.4, 2}), {-0.2, -0.2, 0});
  return shapes::noisy(shapes::joined(plate, pin), noise);
}

TEST(GroundTest, SolidsHaveNone) {
  EXPECT_FALSE(find_ground(shapes::sphere(5000)).plane);
  EXPECT_FALSE(find_ground(shapes::dumbbell(5000)).plane);
  EXPECT_FALSE(find_ground(shapes::torus(5000, 2.0, 0.6)).plane);
  for (const Vec3& size : {Vec3{1, 1, 1}, Vec3{3, 2, 0.3}, Vec3{3, 2, 0.05}, Vec3{9, 1, 1}}) {
    for (const double noise : {0.0, 0.01}) {
      EXPECT_FALSE(find_ground(shapes::noisy(shapes::box(8000, size), noise)).plane) << size.z;
    }
  }
}

TEST(GroundTest, PlatesAndTableTopsAreNone) {
  for (const double thickness : {0.4, 0.1, 0.05}) {
    for (const double noise : {0.0, 0.005, 0.01}) {
      EXPECT_FALSE(find_ground(pin_on_plate(thickness, noise)).plane) << thickness << " " << noise;
    }
  }
}

TEST(GroundTest, SheetsAndCloudsHaveNone) {
  EXPECT_FALSE(find_ground(plane(5000, 2.0)).plane);
  EXPECT_FALSE(find_ground(shapes::noisy(plane(5000, 2.0), 0.01)).plane);
  EXPECT_FALSE(find_ground(shapes::cube_cloud(5000)).plane);
  EXPECT_FALSE(find_ground(shapes::grid(12)).plane);
  for (const std::size_t count : {0U, 1U, 2U, 3U, 4U, 20U}) {
    EXPECT_FALSE(find_ground(shapes::cube_cloud(count)).plane);
    EXPECT_FALSE(find_ground(Points(count, {1, 2, 3})).plane);
  }
}

// --- options, order, errors -------------------------------------------------------------------

TEST(GroundTest, KeepsOrRemovesWhenTold) {
  const Points clear = scanned_box(4.0, 0.005);
  EXPECT_FALSE(find_ground(clear, {.mode = GroundMode::kKeep}).plane);
  // Half of the plane is missing.
  Points half = clear;
  std::erase_if(half, [](const Vec3& p) { return p.x < -0.52; });
  EXPECT_FALSE(find_ground(half).plane);
  const Ground ground = find_ground(half, {.mode = GroundMode::kRemove});
  ASSERT_TRUE(ground.plane);
  EXPECT_GT(ground.plane->normal.z, 0.999);
  EXPECT_GT(count_apart(ground), 1000U);
  // Nothing stands on it.
  EXPECT_FALSE(find_ground(plane(5000, 2.0), {.mode = GroundMode::kRemove}).plane);
}

TEST(GroundTest, OrderAndThreadsDoNotMatter) {
  const Points points = scanned_box(3.0, 0.005);
  const Ground expected = find_ground(points, {.threads = 1});
  ASSERT_TRUE(expected.plane);
  const auto order = shapes::permutation(points.size());
  const Ground permuted = find_ground(shapes::permuted(points, order), {.threads = 2});
  EXPECT_EQ(permuted.plane->normal, expected.plane->normal);
  EXPECT_EQ(permuted.plane->offset, expected.plane->offset);
  EXPECT_TRUE(permuted.base == expected.base);
  EXPECT_TRUE(permuted.apart == shapes::permuted(expected.apart, order));
}

TEST(GroundTest, NamesThePointThatIsNotFinite) {
  Points points = shapes::sphere(100);
  points[42].z = std::numeric_limits<double>::infinity();
  try {
    (void)find_ground(points);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInput);
    EXPECT_NE(std::string(error.what()).find("point 42 "), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace morsel
