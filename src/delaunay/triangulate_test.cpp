#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <morsel/delaunay.hpp>
#include <morsel/error.hpp>
#include <ostream>
#include <set>
#include <string>

#include "base/test_shapes.hpp"
#include "delaunay/test_complex.hpp"

namespace morsel {
namespace {

using shapes::Points;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 exact(const Vec3& p) { return {p.x, p.y, p.z}; }

const Points kTetrahedron{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};

double total_volume(const DelaunayComplex& complex) {
  double sum = 0.0;
  for (std::size_t c = 0; c < complex.cell_count(); ++c) sum += cell_volume(complex, c);
  return sum;
}

void expect_empty_balls(const DelaunayComplex& complex) {
  for (std::size_t c = 0; c < complex.cell_count(); ++c) {
    const auto& [i, j, k, l] = complex.cells[c];
    for (const Vec3& p : complex.vertices) {
      EXPECT_NE(CGAL::side_of_bounded_sphere(exact(complex.vertices[i]), exact(complex.vertices[j]),
                                             exact(complex.vertices[k]), exact(complex.vertices[l]),
                                             exact(p)),
                CGAL::ON_BOUNDED_SIDE);
    }
  }
}

void expect_symmetric_neighbors(const DelaunayComplex& complex) {
  const auto facet = [&](std::size_t cell, std::size_t slot) {
    std::set<std::uint32_t> corners(complex.cells[cell].begin(), complex.cells[cell].end());
    corners.erase(complex.cells[cell][slot]);
    return corners;
  };
  for (std::uint32_t c = 0; c < complex.cell_count(); ++c) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t d = complex.neighbors[c][i];
      if (d == kNoCell) continue;
      ASSERT_LT(d, complex.cell_count());
      const auto back = std::ranges::find(complex.neighbors[d], c);
      ASSERT_NE(back, complex.neighbors[d].end());
      EXPECT_EQ(facet(c, i),
                facet(d, static_cast<std::size_t>(back - complex.neighbors[d].begin())));
    }
  }
}

// What must hold for any cloud.
void expect_sound(const Points& points, const DelaunayComplex& complex) {
  ASSERT_EQ(complex.vertex_of_point.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_LT(complex.vertex_of_point[i], complex.vertices.size());
    EXPECT_EQ(complex.vertices[complex.vertex_of_point[i]], points[i]);
  }
  ASSERT_EQ(complex.neighbors.size(), complex.cell_count());
  ASSERT_EQ(complex.centers.size(), complex.cell_count());
  ASSERT_EQ(complex.radii.size(), complex.cell_count());
  EXPECT_EQ(complex.dimension == 3, complex.cell_count() > 0);
  expect_positive(complex);
  expect_symmetric_neighbors(complex);
}

void expect_same(const DelaunayComplex& a, const DelaunayComplex& b) {
  EXPECT_EQ(a.dimension, b.dimension);
  EXPECT_TRUE(a.vertices == b.vertices);
  EXPECT_TRUE(a.cells == b.cells);
  EXPECT_TRUE(a.neighbors == b.neighbors);
  EXPECT_TRUE(a.centers == b.centers);
  EXPECT_TRUE(a.radii == b.radii);
}

struct Counted {
  const char* name;
  Points points;
  std::size_t vertices;
  std::size_t cells;
  int dimension;

  friend void PrintTo(const Counted& counted, std::ostream* out) { *out << counted.name; }
};

class SmallCloudTest : public ::testing::TestWithParam<Counted> {};

TEST_P(SmallCloudTest, HasTheCountedCells) {
  const Counted& counted = GetParam();
  const DelaunayComplex complex = triangulate(counted.points);
  EXPECT_EQ(complex.vertices.size(), counted.vertices);
  EXPECT_EQ(complex.cell_count(), counted.cells);
  EXPECT_EQ(complex.dimension, counted.dimension);
  expect_sound(counted.points, complex);
  expect_empty_balls(complex);
}

INSTANTIATE_TEST_SUITE_P(
    , SmallCloudTest,
    ::testing::Values(
        Counted{"Empty", {}, 0, 0, -1}, Counted{"One", {{1, 2, 3}}, 1, 0, 0},
        Counted{"Two", {{1, 2, 3}, {0, 0, 0}}, 2, 0, 1},
        Counted{"Three", {{1, 2, 3}, {0, 0, 0}, {1, 0, 0}}, 3, 0, 2},
        Counted{"Tetrahedron", kTetrahedron, 4, 1, 3},
        Counted{"CentredTetrahedron", shapes::joined(kTetrahedron, {{0, 0, 0}}), 5, 4, 3},
        Counted{
            "Bipyramid", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -1}}, 5, 2, 3},
        Counted{"RepeatedTetrahedron", shapes::joined(kTetrahedron, kTetrahedron), 4, 1, 3},
        Counted{"Identical", Points(40, {2, 2, 2}), 1, 0, 0},
        Counted{"Collinear", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}, {9, 9, 9}}, 5, 0, 1},
        Counted{"Coplanar", {{0, 0, 7}, {1, 0, 7}, {0, 1, 7}, {1, 1, 7}, {5, 2, 7}}, 5, 0, 2}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(TriangulateTest, RegularTetrahedron) {
  const DelaunayComplex complex = triangulate(kTetrahedron);
  ASSERT_EQ(complex.cell_count(), 1U);
  EXPECT_NEAR(complex.radii[0], std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(norm(complex.centers[0]), 0.0, 1e-14);
  EXPECT_NEAR(cell_volume(complex, 0), 8.0 / 3.0, 1e-14);
  EXPECT_NEAR(norm(cell_centroid(complex, 0)), 0.0, 1e-14);
  for (const std::uint32_t d : complex.neighbors[0]) EXPECT_EQ(d, kNoCell);
}

TEST(TriangulateTest, CubeOfEightCosphericalPoints) {
  const Points cube = shapes::grid(2);
  const DelaunayComplex complex = triangulate(cube);
  EXPECT_GE(complex.cell_count(), 5U);  // a cube takes five or six tetrahedra
  EXPECT_LE(complex.cell_count(), 6U);
  EXPECT_NEAR(total_volume(complex), 1.0, 1e-14);
  expect_sound(cube, complex);
  for (const double r : complex.radii) EXPECT_NEAR(r, std::sqrt(0.75), 1e-12);
  expect_same(complex, triangulate(shapes::permuted(cube, shapes::permutation(8))));
}

TEST(TriangulateTest, BallsAreEmpty) {
  const Points points = shapes::cube_cloud(200);
  const DelaunayComplex complex = triangulate(points);
  expect_sound(points, complex);
  expect_empty_balls(complex);
  for (std::size_t c = 0; c < complex.cell_count(); ++c) {
    for (const Vec3& p : complex.vertices) {
      EXPECT_GE(distance(p, complex.centers[c]), complex.radii[c] * (1.0 - 1e-9));
    }
  }
}

TEST(TriangulateTest, VolumesAddUpToTheConvexHull) {
  const Points cube = shapes::joined(shapes::cube_cloud(2000), shapes::grid(2));
  EXPECT_NEAR(total_volume(triangulate(cube)), 1.0, 1e-12);
  const Points box = shapes::joined(shapes::box(2000, {1, 2, 3}),
                                    shapes::changed(shapes::grid(2), [](const Vec3& p) {
                                      return Vec3{p.x, 2.0 * p.y, 3.0 * p.z};
                                    }));
  EXPECT_NEAR(total_volume(triangulate(box)), 6.0, 1e-11);
}

TEST(TriangulateTest, GridIsSound) {
  const Points points = shapes::grid(6);
  const DelaunayComplex complex = triangulate(points);
  expect_sound(points, complex);
  expect_empty_balls(complex);
  EXPECT_NEAR(total_volume(complex), 125.0, 1e-9);
}

TEST(TriangulateTest, DoesNotDependOnTheOrderOfThePoints) {
  for (const Points& points : {shapes::cube_cloud(3000), shapes::grid(9), shapes::sphere(3000)}) {
    const auto shuffle = shapes::permutation(points.size());
    const DelaunayComplex complex = triangulate(points);
    const DelaunayComplex shuffled = triangulate(shapes::permuted(points, shuffle));
    expect_same(complex, shuffled);
    EXPECT_EQ(shapes::permuted(complex.vertex_of_point, shuffle), shuffled.vertex_of_point);
  }
}

// Above 50,000 points CGAL inserts in parallel; a grid has cospherical points everywhere.
TEST(TriangulateTest, DoesNotDependOnTheNumberOfThreads) {
  for (const Points& points : {shapes::cube_cloud(55000), shapes::grid(38)}) {
    const DelaunayComplex complex = triangulate(points, {.threads = 1});
    expect_same(complex, triangulate(points, {.threads = 2}));
  }
}

TEST(TriangulateTest, FarFromTheOriginIsTheSame) {
  Random random(8);
  Points points(2000);
  const auto coordinate = [&] {
    return std::ldexp(static_cast<double>(random.below(1 << 20)), -20);
  };
  for (Vec3& p : points) {
    p.x = coordinate();
    p.y = coordinate();
    p.z = coordinate();
  }
  const DelaunayComplex near = triangulate(points);
  const Vec3 offset{1e6, -2e6, 3e6};
  const DelaunayComplex far = triangulate(shapes::moved(points, offset));
  EXPECT_TRUE(near.cells == far.cells);
  EXPECT_TRUE(near.neighbors == far.neighbors);
  EXPECT_EQ(near.vertex_of_point, far.vertex_of_point);
  for (std::size_t c = 0; c < near.cell_count(); ++c) {
    EXPECT_NEAR(far.radii[c], near.radii[c], 1e-6 * near.radii[c]);
  }
}

TEST(TriangulateTest, ScaleDoesNotMatter) {
  const Points points = shapes::cube_cloud(1500);
  const DelaunayComplex complex = triangulate(points);
  for (const int exponent : {-40, -20, 20, 40}) {
    const double factor = std::ldexp(1.0, exponent);
    const DelaunayComplex other = triangulate(shapes::scaled(points, factor));
    EXPECT_TRUE(other.cells == complex.cells);
    for (std::size_t c = 0; c < complex.cell_count(); ++c) {
      EXPECT_EQ(other.radii[c], factor * complex.radii[c]);
    }
  }
  for (const double factor : {1e-6, 1e6}) {
    const Points scaled = shapes::scaled(points, factor);
    const DelaunayComplex other = triangulate(scaled);
    expect_sound(scaled, other);
    EXPECT_NEAR(total_volume(other) / (factor * factor * factor), total_volume(complex), 1e-9);
  }
}

TEST(TriangulateTest, NamesThePointThatIsNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    for (int axis = 0; axis < 3; ++axis) {
      Points points = shapes::cube_cloud(50);
      (axis == 0 ? points[37].x : axis == 1 ? points[37].y : points[37].z) = bad;
      try {
        (void)triangulate(points);
        FAIL();
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput);
        EXPECT_NE(std::string(error.what()).find("point 37 "), std::string::npos) << error.what();
      }
    }
  }
}

TEST(TriangulateTest, ManyPointsInOnePlaneHaveNoCells) {
  Points flat = shapes::cube_cloud(55000);
  for (Vec3& p : flat) p.z = 0.0;
  const DelaunayComplex complex = triangulate(flat, {.threads = 2});
  EXPECT_EQ(complex.dimension, 2);
  EXPECT_EQ(complex.cell_count(), 0U);
}

TEST(TriangulateTest, CanBeCancelled) {
  Progress progress;
  progress.cancel();
  try {
    (void)triangulate(shapes::cube_cloud(100), {}, &progress);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

}  // namespace
}  // namespace morsel
