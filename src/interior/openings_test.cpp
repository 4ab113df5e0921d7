#include "interior/openings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "base/test_shapes.hpp"

namespace morsel {
namespace {

using shapes::Points;

constexpr double kUnitBall = 4.0 / 3.0 * std::numbers::pi;

Interior label(const Points& points) {
  const DelaunayComplex complex = triangulate(points);
  const VertexCells vertex_cells = find_vertex_cells(complex);
  return find_interior(complex, vertex_cells, mean_neighbor_distance(complex));
}

// Without the points above the plane z = height.
Points cut_at(Points points, double height) {
  std::erase_if(points, [&](const Vec3& p) { return p.z > height; });
  return points;
}

// Without those nearer to `center` than `radius`.
Points with_hole(Points points, const Vec3& center, double radius) {
  std::erase_if(points, [&](const Vec3& p) { return distance(p, center) < radius; });
  return points;
}

// A cube from -1 to 1.
Points cube() { return shapes::moved(shapes::box(12000, {2.0, 2.0, 2.0}), {-1.0, -1.0, -1.0}); }

// Of a unit ball below the plane z = height.
double ball_below(double height) {
  const double cap = 1.0 - height;
  return kUnitBall - std::numbers::pi * cap * cap * (3.0 - cap) / 3.0;
}

TEST(OpeningsTest, AClosedSurfaceHasNone) {
  for (const Points& points : {shapes::sphere(4000), shapes::torus(6000, 2.0, 0.7),
                               shapes::noisy(shapes::dumbbell(6000), 0.01)}) {
    const Interior interior = label(points);
    EXPECT_TRUE(interior.openings.empty());
    EXPECT_LT(interior.bare_share, 0.01);
  }
}

TEST(OpeningsTest, ABallIsClosedAcrossAnOpening) {
  for (const double height : {0.95, 0.8, 0.6}) {
    const Interior interior = label(cut_at(shapes::sphere(8000), height));
    EXPECT_NEAR(interior.volume, ball_below(height), 0.05 * kUnitBall) << height;
    EXPECT_LT(interior.bare_share, 0.02);
    EXPECT_LT(interior.open_share, 0.2);
  }
}

TEST(OpeningsTest, ACubeIsClosedAcrossAHoleInAFace) {
  for (const double radius : {0.5, 0.7}) {
    const Interior interior = label(with_hole(cube(), {0.0, 0.0, 1.0}, radius));
    EXPECT_NEAR(interior.volume, 8.0, 0.4) << radius;
    EXPECT_LT(interior.bare_share, 0.02);
    ASSERT_EQ(interior.openings.size(), 1U) << radius;
    EXPECT_NEAR(interior.openings[0].radius, radius, 0.2 * radius);
    EXPECT_NEAR(interior.openings[0].center.x, 0.0, 0.1);
    EXPECT_NEAR(interior.openings[0].center.z, 1.0, 0.15);
  }
}

TEST(OpeningsTest, AHalfSphereIsMostlyOpen) {
  EXPECT_NEAR(label(cut_at(shapes::sphere(8000), 0.0)).open_share, 1.0 / 3.0, 0.02);
}

TEST(OpeningsTest, ASheetStaysBare) {
  Points sheet;
  Random random(4);
  for (int i = 0; i < 5000; ++i) {
    const double x = random.uniform();
    const double y = random.uniform();
    sheet.push_back({x, y, 0.1 * std::sin(6.0 * x) * std::cos(5.0 * y)});
  }
  EXPECT_GT(label(sheet).bare_share, 0.5);
}

TEST(OpeningsTest, TheWidestComesFirst) {
  const Points points = with_hole(with_hole(cube(), {0.0, 0.0, 1.0}, 0.55), {0.0, -1.0, 0.0}, 0.7);
  const Interior interior = label(points);
  ASSERT_EQ(interior.openings.size(), 2U);
  EXPECT_GT(interior.openings[0].radius, interior.openings[1].radius);
  EXPECT_LT(interior.openings[0].center.y, -0.8);
  EXPECT_GT(interior.openings[1].center.z, 0.8);
}

// A bowl with walls: the hollow is entered through a narrow mouth, but behind its surface is the
// bowl's own inside.
TEST(OpeningsTest, AHollowWithWallsIsNotFilled) {
  Points points = cut_at(shapes::sphere(8000), 0.9);
  for (Vec3 p : cut_at(shapes::sphere(5000), 0.9)) {
    const Vec3 inner = 0.7 * p;
    points.push_back(inner);
  }
  // The rim: a cone between the two edges.
  const double radius = std::sqrt(1.0 - 0.9 * 0.9);
  for (int i = 0; i < 400; ++i) {
    const double angle = 2.0 * std::numbers::pi * 0.6180339887 * i;
    const double share = 0.7 + 0.3 * (i + 0.5) / 400.0;
    points.push_back(
        {share * radius * std::cos(angle), share * radius * std::sin(angle), share * 0.9});
  }
  const Interior interior = label(points);
  const double wall = ball_below(0.9) * (1.0 - 0.7 * 0.7 * 0.7);
  EXPECT_NEAR(interior.volume, wall, 0.1 * wall);
  EXPECT_TRUE(interior.openings.empty());
}

TEST(OpeningsTest, ThreadsChangeNothing) {
  const DelaunayComplex complex = triangulate(with_hole(cube(), {0.0, 0.0, 1.0}, 0.5));
  const VertexCells vertex_cells = find_vertex_cells(complex);
  const auto lambda = mean_neighbor_distance(complex);
  EXPECT_EQ(find_interior(complex, vertex_cells, lambda, {}, 1).side,
            find_interior(complex, vertex_cells, lambda, {}, 2).side);
}

}  // namespace
}  // namespace morsel
