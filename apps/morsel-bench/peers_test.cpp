// The peers give what they are known for on a shape that has no two opinions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/test_shapes.hpp"
#include "sdf.hpp"
#include "supervoxels.hpp"
#include "tomato.hpp"

namespace morsel::bench {
namespace {

constexpr double kBall = 1.0;
constexpr double kBar = 0.3;
constexpr double kHalf = 2.0;  // from the middle of the bar to that of a ball

// A dumbbell along x: radii over x, turned around it, poles at the ends.
TriangleMesh dumbbell_mesh() {
  constexpr std::uint32_t kRings = 120;
  constexpr std::uint32_t kAround = 24;
  const double end = kHalf + kBall;
  TriangleMesh mesh;
  for (std::uint32_t ring = 1; ring < kRings; ++ring) {
    const double x = -end * std::cos(std::numbers::pi * ring / kRings);
    const double off = std::abs(x) - kHalf;
    const double ball = std::sqrt(std::max(kBall * kBall - off * off, 0.0));
    const double radius = std::abs(x) < kHalf ? std::max(ball, kBar) : ball;
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kAround;
      mesh.vertices.push_back({x, radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  const auto at = [](std::uint32_t ring, std::uint32_t k) { return ring * kAround + k % kAround; };
  const auto left = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({-end, 0.0, 0.0});
  mesh.vertices.push_back({end, 0.0, 0.0});
  for (std::uint32_t k = 0; k < kAround; ++k) {
    mesh.triangles.push_back({left, at(0, k + 1), at(0, k)});
    mesh.triangles.push_back({left + 1, at(kRings - 2, k), at(kRings - 2, k + 1)});
    for (std::uint32_t ring = 0; ring + 2 < kRings; ++ring) {
      mesh.triangles.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k)});
      mesh.triangles.push_back({at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)});
    }
  }
  return mesh;
}

TEST(PeersTest, ShapeDiametersTellBallsFromTheBar) {
  const TriangleMesh mesh = dumbbell_mesh();
  const std::vector<int> labels = sdf_labels(mesh, {.clusters = 2});
  ASSERT_EQ(labels.size(), mesh.triangles.size());
  std::set<int> left;
  std::set<int> middle;
  std::set<int> right;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double x = mesh.vertices[mesh.triangles[i][0]].x;
    if (x < -kHalf) left.insert(labels[i]);
    if (std::abs(x) < 0.5) middle.insert(labels[i]);
    if (x > kHalf) right.insert(labels[i]);
  }
  EXPECT_EQ(left.size(), 1U);
  EXPECT_EQ(middle.size(), 1U);
  EXPECT_EQ(right.size(), 1U);
  std::set<int> all = left;
  all.merge(middle);
  all.merge(right);
  EXPECT_EQ(all.size(), 3U);
}

// The labels of a dumbbell's points beyond the centres of its two balls.
std::pair<std::set<int>, std::set<int>> ends(const shapes::Points& points,
                                             const std::vector<int>& labels) {
  std::pair<std::set<int>, std::set<int>> result;
  const auto [low, high] = std::ranges::minmax_element(points, {}, &Vec3::x);
  const double middle = 0.5 * (low->x + high->x);
  const double far = 0.4 * (high->x - low->x);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].x < middle - far) result.first.insert(labels[i]);
    if (points[i].x > middle + far) result.second.insert(labels[i]);
  }
  return result;
}

TEST(PeersTest, ConvexPatchesKeepTheBallsApart) {
  if (!has_supervoxels()) GTEST_SKIP() << "built without PCL";
  const shapes::Points points = shapes::dumbbell(20000);
  for (const auto& labels : {lccp_labels(points, {}), cpc_labels(points, {})}) {
    ASSERT_EQ(labels.size(), points.size());
    const auto [left, right] = ends(points, labels);
    for (const int label : left) EXPECT_FALSE(right.contains(label));
  }
}

TEST(PeersTest, PeaksOfDensityAreClusters) {
  if (!has_tomato()) GTEST_SKIP() << "no GUDHI for Python";
  const shapes::Points points =
      shapes::joined(shapes::sphere(2000), shapes::sphere(2000, {10.0, 0.0, 0.0}));
  const TomatoResult result = tomato(points, {});
  ASSERT_EQ(result.labels.size(), points.size());
  const auto [left, right] = ends(points, result.labels);
  for (const int label : left) EXPECT_FALSE(right.contains(label));
  EXPECT_GT(result.core_seconds, 0.0);
}

}  // namespace
}  // namespace morsel::bench
