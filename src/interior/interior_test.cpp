#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <morsel/error.hpp>
#include <morsel/interior.hpp>
#include <numbers>

#include "base/test_shapes.hpp"
#include "base/union_find.hpp"

namespace morsel {
namespace {

using shapes::Points;

constexpr double kPi = std::numbers::pi;
constexpr double kUnitBall = 4.0 / 3.0 * kPi;

struct Labelled {
  DelaunayComplex complex;
  Interior interior;
};

Labelled label(const Points& points, const InteriorOptions& options = {}) {
  Labelled result;
  result.complex = triangulate(points);
  const VertexCells vertex_cells = find_vertex_cells(result.complex);
  const auto lambda = mean_neighbor_distance(result.complex);
  result.interior = find_interior(result.complex, vertex_cells, lambda, options);
  return result;
}

void expect_consistent(const Labelled& labelled) {
  const Interior& interior = labelled.interior;
  ASSERT_EQ(interior.side.size(), labelled.complex.cell_count());
  std::size_t inner = 0;
  std::size_t outer = 0;
  double volume = 0.0;
  for (std::size_t c = 0; c < interior.side.size(); ++c) {
    outer += interior.side[c] == CellSide::kOuter ? 1 : 0;
    if (interior.side[c] != CellSide::kInner) continue;
    ++inner;
    volume += cell_volume(labelled.complex, c);
  }
  EXPECT_EQ(inner, interior.inner_cells);
  EXPECT_EQ(outer, interior.outer_cells);
  EXPECT_NEAR(volume, interior.volume, 1e-9 * volume);
}

std::size_t inner_groups(const Labelled& labelled) {
  const auto& side = labelled.interior.side;
  UnionFind groups(side.size());
  std::size_t count = labelled.interior.inner_cells;
  for (std::uint32_t c = 0; c < side.size(); ++c) {
    for (const std::uint32_t d : labelled.complex.neighbors[c]) {
      if (d == kNoCell || side[c] != CellSide::kInner || side[d] != CellSide::kInner) continue;
      count -= groups.join(c, d) ? 1 : 0;
    }
  }
  return count;
}

void expect_volume(const Points& points, double volume, double tolerance,
                   const InteriorOptions& options = {}) {
  const Labelled labelled = label(points, options);
  expect_consistent(labelled);
  EXPECT_NEAR(labelled.interior.volume / volume, 1.0, tolerance);
}

TEST(InteriorTest, Ball) { expect_volume(shapes::sphere(20000), kUnitBall, 0.02); }

TEST(InteriorTest, Box) { expect_volume(shapes::box(12000, {1, 2, 3}), 6.0, 0.02); }

TEST(InteriorTest, TorusKeepsItsHole) {
  expect_volume(shapes::torus(20000, 2.0, 0.6), 2.0 * kPi * kPi * 2.0 * 0.36, 0.02);
}

TEST(InteriorTest, NoisyBall) {
  expect_volume(shapes::noisy(shapes::sphere(12000), 0.01), kUnitBall, 0.05);
}

TEST(InteriorTest, TwoBallsAreTwoGroups) {
  const Points points = shapes::joined(shapes::sphere(8000, {-1.5, 0, 0}, 1.0, 1),
                                       shapes::sphere(8000, {1.5, 0, 0}, 1.0, 2));
  const Labelled labelled = label(points);
  EXPECT_NEAR(labelled.interior.volume / (2.0 * kUnitBall), 1.0, 0.02);
  EXPECT_EQ(inner_groups(labelled), 2U);
}

// A closed wall hides whether what it encloses is hollow: the published walk reaches outer cells
// only from beyond the hull, so the cavity counts as inside.
TEST(InteriorTest, AnEnclosedCavityCountsAsInside) {
  const Points points =
      shapes::joined(shapes::sphere(14000, {}, 1.0, 1), shapes::sphere(6000, {}, 0.6, 2));
  expect_volume(points, kUnitBall, 0.02);
}

// Samples lie 0.02 apart on each side; no ball within is four times larger than their spacing.
TEST(InteriorTest, PlatesAsThinAsTwoSpacings) {
  for (const double thickness : {0.04, 0.06, 0.08}) {
    expect_volume(shapes::box(5000, {1, 1, thickness}), thickness, 0.05);
  }
}

TEST(InteriorTest, ABarAsThinAsThreeSpacings) {
  expect_volume(shapes::box(1000, {4, 0.1, 0.1}), 4 * 0.1 * 0.1, 0.2);
}

TEST(InteriorTest, ThinBoardsAboveEachOther) {
  const Points boards =
      shapes::joined(shapes::box(5000, {1, 1, 0.06}),
                     shapes::moved(shapes::box(5000, {1, 1, 0.06}, 2), {0, 0, 0.26}));
  const Labelled labelled = label(boards);
  expect_consistent(labelled);
  EXPECT_NEAR(labelled.interior.volume, 0.12, 0.006);
}

TEST(InteriorTest, DefaultMethodLeavesNoCellOpen) {
  for (const Points& points : {shapes::sphere(4000), shapes::dumbbell(6000),
                               shapes::noisy(shapes::torus(6000, 2.0, 0.6), 0.02)}) {
    const Labelled labelled = label(points);
    expect_consistent(labelled);
    EXPECT_EQ(labelled.interior.inner_cells + labelled.interior.outer_cells,
              labelled.complex.cell_count());
  }
}

TEST(InteriorTest, ScalingByAPowerOfTwoKeepsEverySide) {
  const Points points = shapes::dumbbell(5000);
  const Labelled labelled = label(points);
  for (const double factor : {0x1.0p-20, 0x1.0p20}) {
    const Labelled scaled = label(shapes::scaled(points, factor));
    EXPECT_TRUE(scaled.interior.side == labelled.interior.side);
  }
}

// rho 2 and 30 degrees separate inside from outside on a dense even sample.
TEST(InteriorTest, PaperMethodOnADenseEvenSample) {
  const InteriorOptions options{
      .method = Method::kPaper, .big_ball_ratio = 2.0, .deep_angle = 30.0};
  expect_volume(shapes::even_sphere(5000), kUnitBall, 0.03, options);
}

TEST(InteriorTest, PaperMethodFollowsItsParameters) {
  const Points points = shapes::sphere(5000);
  // No ball is that big.
  const Labelled none = label(points, {Method::kPaper, 1e9, 60.0});
  expect_consistent(none);
  EXPECT_EQ(none.interior.inner_cells + none.interior.outer_cells, 0U);
  // Every ball is big and no balls but equal ones meet at 0 degrees: nothing is reached.
  const Labelled all = label(points, {Method::kPaper, 1e-9, 0.0});
  expect_consistent(all);
  EXPECT_EQ(all.interior.outer_cells, 0U);
  EXPECT_EQ(all.interior.inner_cells, all.complex.cell_count());
}

TEST(InteriorTest, DegenerateClouds) {
  for (const Method method : {Method::kDefault, Method::kPaper}) {
    for (const Points& points : {Points{}, shapes::cube_cloud(1), shapes::cube_cloud(4),
                                 shapes::cube_cloud(5), shapes::grid(2), shapes::grid(6)}) {
      expect_consistent(label(points, {.method = method}));
    }
  }
}

TEST(InteriorTest, OptionsAreChecked) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  InteriorOptions{}.check();
  for (const double ratio : {0.0, -1.0, kNaN}) {
    EXPECT_THROW((InteriorOptions{.big_ball_ratio = ratio}.check()), Error);
  }
  for (const double angle : {-1.0, 180.5, kNaN}) {
    EXPECT_THROW((InteriorOptions{.deep_angle = angle}.check()), Error);
  }
  InteriorOptions{.deep_angle = 0.0}.check();
  InteriorOptions{.deep_angle = 180.0}.check();
  try {
    (void)label(shapes::cube_cloud(5), {.deep_angle = 200.0});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUsage);
    EXPECT_NE(std::string(error.what()).find("deep_angle is 200"), std::string::npos);
  }
}

}  // namespace
}  // namespace morsel
