#include "delaunay/balls.hpp"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

using shapes::Points;
using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;

Exact::Point_3 exact(const Vec3& p) { return {p.x, p.y, p.z}; }

DelaunayComplex one_cell(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  DelaunayComplex complex;
  complex.vertices = {p, q, r, s};
  complex.cells = {{0, 1, 2, 3}};
  complex.neighbors = {{kNoCell, kNoCell, kNoCell, kNoCell}};
  compute_balls(complex, 1);
  return complex;
}

TEST(BallsTest, CentresAreEquidistantFromTheCorners) {
  for (const Points& points :
       {shapes::cube_cloud(500), shapes::even_sphere(500), shapes::grid(5)}) {
    const DelaunayComplex complex = triangulate(points);
    for (std::size_t c = 0; c < complex.cell_count(); ++c) {
      for (const std::uint32_t v : complex.cells[c]) {
        EXPECT_NEAR(distance(complex.vertices[v], complex.centers[c]), complex.radii[c],
                    1e-6 * complex.radii[c]);
      }
    }
  }
}

TEST(BallsTest, NearlyFlatCellsAreComputedExactly) {
  // On the unit circle and h above its centre.
  constexpr double kHeight = 0x1.0p-40;
  const DelaunayComplex complex = one_cell({1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, kHeight});
  // |c|² + 1 = (h - c)² for a centre (0, 0, c).
  const double height = (kHeight * kHeight - 1.0) / (2.0 * kHeight);
  EXPECT_NEAR(complex.centers[0].z, height, 1e-12 * std::abs(height));
  EXPECT_NEAR(complex.centers[0].x, 0.0, 1e-12 * std::abs(height));
  EXPECT_NEAR(complex.radii[0], std::hypot(height, 1.0), 1e-12 * std::abs(height));
}

TEST(BallsTest, Circumradius) {
  EXPECT_NEAR(circumradius({0, 0, 0}, {3, 0, 0}, {0, 4, 0}), 2.5, 1e-15);
  EXPECT_NEAR(circumradius({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), std::sqrt(2.0 / 3.0), 1e-15);
  EXPECT_EQ(circumradius({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), std::numeric_limits<double>::infinity());
}

TEST(BallsTest, FacetNormalsPointOutwards) {
  const DelaunayComplex complex = triangulate(shapes::cube_cloud(100));
  for (const auto& cell : complex.cells) {
    for (int i = 0; i < 4; ++i) {
      const Vec3& a = complex.vertices[cell[kFacetSlots[i][0]]];
      const Vec3& b = complex.vertices[cell[kFacetSlots[i][1]]];
      const Vec3& c = complex.vertices[cell[kFacetSlots[i][2]]];
      EXPECT_LT(dot(cross(b - a, c - a), complex.vertices[cell[i]] - a), 0.0);
    }
  }
}

TEST(EquatorialSphereTest, HandCases) {
  const Vec3 a{1, 0, 0};
  const Vec3 b{-1, 0, 0};
  const Vec3 c{0, 1, 0};
  EXPECT_TRUE(inside_equatorial_sphere(a, b, c, {0, 0, 0}));
  EXPECT_TRUE(inside_equatorial_sphere(a, b, c, {0, 0, 0.999}));
  EXPECT_FALSE(inside_equatorial_sphere(a, b, c, {0, 0, 1}));  // on it
  EXPECT_FALSE(inside_equatorial_sphere(a, b, c, {0, -1, 0}));
  EXPECT_FALSE(inside_equatorial_sphere(a, b, c, {1, 1, 1}));
  EXPECT_TRUE(inside_equatorial_sphere(a, b, c, {0, 0, std::nextafter(1.0, 0.0)}));
  EXPECT_FALSE(inside_equatorial_sphere(a, b, c, {0, 0, std::nextafter(1.0, 2.0)}));
}

// Grid points make many exact ties; steps of 0.1 and far offsets make near ties.
TEST(EquatorialSphereTest, AgreesWithRationalNumbers) {
  Random random(4);
  int compared = 0;
  int ties = 0;
  for (const double step : {1.0, 0.1, 1e-6, 1e6, 0x1p-176, 0x1p-180, 0x1p-300}) {
    for (const double offset : {0.0, 1e6}) {
      const auto coordinate = [&] {
        return offset * step + step * static_cast<double>(random.below(4));
      };
      const auto point = [&] {
        const double x = coordinate();
        const double y = coordinate();
        return Vec3{x, y, coordinate()};
      };
      for (int i = 0; i < 1500; ++i) {
        const Vec3 a = point();
        const Vec3 b = point();
        const Vec3 c = point();
        const Vec3 test = point();
        if (CGAL::collinear(exact(a), exact(b), exact(c))) continue;
        const auto side = CGAL::side_of_bounded_sphere(exact(a), exact(b), exact(c), exact(test));
        EXPECT_EQ(inside_equatorial_sphere(a, b, c, test), side == CGAL::ON_BOUNDED_SIDE);
        ++compared;
        ties += side == CGAL::ON_BOUNDARY ? 1 : 0;
      }
    }
  }
  EXPECT_GT(compared, 14000);
  EXPECT_GT(ties, 500);
}

// Two cells over one facet whose circle has radius 1 about the origin in the plane z = 0; their
// balls' centres stand at heights `low` and `high` over it.
DelaunayComplex two_balls(double low, double high) {
  DelaunayComplex complex;
  const double half = std::sqrt(0.75);
  complex.vertices = {{1, 0, 0}, {-0.5, half, 0}, {-0.5, -half, 0}, {0, 0, -2}, {0, 0, 2}};
  complex.cells = {{3, 0, 1, 2}, {4, 0, 1, 2}};
  complex.neighbors = {{1, kNoCell, kNoCell, kNoCell}, {0, kNoCell, kNoCell, kNoCell}};
  complex.centers = {{0, 0, low}, {0, 0, high}};
  complex.radii = {std::hypot(1.0, low), std::hypot(1.0, high)};
  return complex;
}

TEST(BallAngleTest, HandCases) {
  EXPECT_NEAR(cos_ball_angle(two_balls(0, 0), 0, 1), 1.0, 1e-15);   // the same ball
  EXPECT_NEAR(cos_ball_angle(two_balls(-1, 1), 0, 1), 0.0, 1e-15);  // a right angle
  EXPECT_NEAR(cos_ball_angle(two_balls(0, 1), 0, 1), std::sqrt(0.5), 1e-15);
}

// A nearly flat cell has a huge ball; the angle to its neighbour's is still told exactly.
TEST(BallAngleTest, HugeBalls) {
  EXPECT_NEAR(cos_ball_angle(two_balls(1e12, 1), 0, 1), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(cos_ball_angle(two_balls(1e12, 0), 0, 1), 0.0, 1e-9);
  EXPECT_NEAR(cos_ball_angle(two_balls(1e12, -1e12), 0, 1), -1.0, 1e-9);
  EXPECT_NEAR(cos_ball_angle(two_balls(1e12, 1e12), 0, 1), 1.0, 1e-9);
}

TEST(BallAngleTest, HullFacetsOfACornerTetrahedron) {
  // Centre (0.5, 0.5, 0.5), radius sqrt(0.75).
  const DelaunayComplex complex = one_cell({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_NEAR(cos_hull_angle(complex, 0, 0), 1.0 / 3.0, 1e-15);
  for (int i = 1; i < 4; ++i) {
    EXPECT_NEAR(cos_hull_angle(complex, 0, i), -1.0 / std::sqrt(3.0), 1e-15);
  }
}

}  // namespace
}  // namespace morsel
