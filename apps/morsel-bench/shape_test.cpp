#include "shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace morsel::bench {
namespace {

double union_distance(std::span<const Capsule> capsules, const Vec3& point) {
  double least = signed_distance(capsules[0], point);
  for (const Capsule& c : capsules) least = std::min(least, signed_distance(c, point));
  return least;
}

TEST(Capsule, HasADistance) {
  const Capsule capsule{{0, 0, 0}, {2, 0, 0}, 1.0};
  EXPECT_DOUBLE_EQ(signed_distance(capsule, {1, 3, 0}), 2.0);
  EXPECT_DOUBLE_EQ(signed_distance(capsule, {1, 0, 0}), -1.0);
  EXPECT_DOUBLE_EQ(signed_distance(capsule, {5, 0, 0}), 2.0);
  EXPECT_DOUBLE_EQ(signed_distance({{1, 1, 1}, {1, 1, 1}, 0.5}, {1, 1, 3}), 1.5);
}

TEST(SampleUnion, LiesOnTheSurface) {
  const auto capsules = beast();
  const auto points = sample_union(capsules, {.count = 3000});
  ASSERT_EQ(points.size(), 3000U);
  for (const Vec3& p : points) EXPECT_NEAR(union_distance(capsules, p), 0.0, 1e-12);
  EXPECT_EQ(points, sample_union(capsules, {.count = 3000}));
}

TEST(SampleUnion, IsUniform) {
  // Side and ends of this capsule have the areas 4π and 4π.
  const std::vector<Capsule> one{{{0, 0, 0}, {2, 0, 0}, 1.0}};
  const auto points = sample_union(one, {.count = 20000});
  const auto on_side = std::count_if(points.begin(), points.end(),
                                     [](const Vec3& p) { return p.x > 0.0 && p.x < 2.0; });
  EXPECT_NEAR(static_cast<double>(on_side), 10000.0, 300.0);
}

TEST(SampleUnion, HasNoiseOfTheGivenSize) {
  const std::vector<Capsule> ball{{{0, 0, 0}, {0, 0, 0}, 1.0}};
  const auto points = sample_union(ball, {.count = 20000, .noise = 0.01});
  double sum = 0.0;
  for (const Vec3& p : points) sum += (norm(p) - 1.0) * (norm(p) - 1.0);
  EXPECT_NEAR(std::sqrt(sum / 20000.0), 0.01 * std::sqrt(12.0), 2e-3);
}

TEST(Bend, MovesPointsALittleAndMakesACylinderUneven) {
  const std::vector<Capsule> one{{{-2, 0, 0}, {2, 0, 0}, 0.5}};
  const auto points = sample_union(one, {.count = 1000});
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
}  // namespace morsel::bench
