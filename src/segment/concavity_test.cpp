#include "segment/concavity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "segment/test_stages.hpp"

namespace morsel {
namespace {

using shapes::Stages;

std::vector<double> concavity_of(const Stages& s) {
  return vertex_concavity(s.complex, s.interior, s.lambda);
}

TEST(ConcavityTest, AConvexShapeHasNone) {
  const Stages s = shapes::run_stages(shapes::sphere(1000));
  const std::vector<double> concavity = concavity_of(s);
  EXPECT_EQ(concavity, std::vector<double>(1000, 0.0));
}

// The tube's ball has radius 0.7; in the hole's middle one of radius 1.3 touches all around.
TEST(ConcavityTest, TheHoleOfATorusIsAsConcaveAsItsBallsSay) {
  const Stages s = shapes::run_stages(shapes::torus(20000, 2.0, 0.7));
  const std::vector<double> concavity = concavity_of(s);
  std::size_t around_hole = 0;
  for (std::size_t v = 0; v < concavity.size(); ++v) {
    const Vec3& p = s.complex.vertices[v];
    const double out = std::hypot(p.x, p.y);
    if (out > 2.5) {
      EXPECT_NEAR(concavity[v], 0.0, 0.02);
    }
    if (out > 1.31) continue;
    ++around_hole;
    EXPECT_NEAR(concavity[v], std::log1p(0.7 / 1.3), 0.05);
  }
  EXPECT_GT(around_hole, 50U);
}

TEST(ConcavityTest, ACreaseIsMoreConcaveThanItsSurroundings) {
  // Two balls that overlap, their outer halves and the ring where they meet.
  shapes::Points points;
  for (const double side : {-0.8, 0.8}) {
    for (const Vec3& p : shapes::sphere(6000, {side, 0.0, 0.0}, 1.0, side < 0.0 ? 1 : 2)) {
      if (p.x * side >= 0.0) points.push_back(p);
    }
  }
  const Stages s = shapes::run_stages(points);
  const std::vector<double> concavity = concavity_of(s);
  double in_crease = kMostConcave;
  double elsewhere = 0.0;
  for (std::size_t v = 0; v < concavity.size(); ++v) {
    const double x = std::abs(s.complex.vertices[v].x);
    if (x < 0.02) in_crease = std::min(in_crease, concavity[v]);
    if (x > 0.8) elsewhere = std::max(elsewhere, concavity[v]);
  }
  EXPECT_GT(in_crease, 1.0);
  EXPECT_EQ(elsewhere, 0.0);
}

// Two scans of one ball that do not quite fit: slits between their layers are no creases.
TEST(ConcavityTest, LayersOfAScanAreNoCreases) {
  const Stages s =
      shapes::run_stages(shapes::joined(shapes::sphere(4000), shapes::sphere(4000, {}, 1.01, 2)));
  const std::vector<double> concavity = concavity_of(s);
  EXPECT_LT(std::ranges::count_if(concavity, [](double c) { return c > 0.5; }), 800);
}

TEST(ConcavityTest, OnlyWhatCurvesInwardsLiesInACrease) {
  EXPECT_EQ(creased(0.0), 0.0);
  EXPECT_LT(creased(0.01), 0.1);
  EXPECT_GT(creased(std::log(2.0)), 0.99);  // a gap as wide as the shape is thick
  EXPECT_LE(creased(kMostConcave), 1.0);
}

TEST(ConcavityTest, DoesNotChangeWithScale) {
  shapes::Points points = shapes::torus(3000, 2.0, 0.7);
  const std::vector<double> small = concavity_of(shapes::run_stages(points));
  for (Vec3& p : points) p = 1024.0 * p;
  EXPECT_EQ(concavity_of(shapes::run_stages(points)), small);
}

}  // namespace
}  // namespace morsel
