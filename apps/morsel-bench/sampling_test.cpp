#include "sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <morsel/error.hpp>
#include <vector>

namespace morsel::bench {
namespace {

// The corner of the unit cube at the origin.
TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

TEST(Sampling, SeedsDependOnRunAndModel) {
  EXPECT_EQ(seed_of_model(1, 5), seed_of_model(1, 5));
  EXPECT_NE(seed_of_model(1, 5), seed_of_model(1, 6));
  EXPECT_NE(seed_of_model(1, 5), seed_of_model(2, 5));
}

TEST(Sampling, AreCarriedOverWithTheirTriangles) {
  const TriangleMesh mesh = tetrahedron();
  TriangleMesh moved = mesh;
  for (Vec3& v : moved.vertices) v = {2.0 * v.y, v.x + v.z, 3.0 - v.z};  // affine, so exact
  const Cloud cloud = sample_cloud(mesh, 3, {.points = 500});
  const std::vector<Vec3> carried = carried_over(cloud, mesh, moved);
  ASSERT_EQ(carried.size(), 500U);
  for (std::size_t i = 0; i < carried.size(); ++i) {
    const Vec3& p = cloud.points[i];
    EXPECT_LT(distance(carried[i], {2.0 * p.y, p.x + p.z, 3.0 - p.z}), 1e-12);
  }
}

TEST(Sampling, OutliersComeLastAndLeaveTheSamplesAlone) {
  const Cloud plain = sample_cloud(tetrahedron(), 3, {.points = 1000});
  const Cloud cloud = sample_cloud(tetrahedron(), 3, {.points = 1000, .outliers = 0.1});
  ASSERT_EQ(cloud.sample_count(), 1000U);
  ASSERT_EQ(cloud.points.size(), 1100U);
  EXPECT_TRUE(std::equal(plain.points.begin(), plain.points.end(), cloud.points.begin()));
  double lowest = 0.0;
  double highest = 1.0;
  for (std::size_t i = cloud.sample_count(); i < cloud.points.size(); ++i) {
    lowest = std::min(lowest, cloud.points[i].x);
    highest = std::max(highest, cloud.points[i].x);
  }
  EXPECT_GE(lowest, -0.25);
  EXPECT_LE(highest, 1.25);
  EXPECT_LT(lowest, -0.1);
  EXPECT_GT(highest, 1.1);
}

TEST(Sampling, ChecksItsOptions) {
  EXPECT_THROW(CloudOptions{.points = 0}.check(), Error);
  EXPECT_THROW(CloudOptions{.noise = -0.1}.check(), Error);
  EXPECT_THROW(CloudOptions{.outliers = 1.5}.check(), Error);
  EXPECT_THROW(CloudOptions{.hole = 1.0}.check(), Error);
}

TEST(FaceLabels, FollowTheMajority) {
  const Cloud cloud{.points = std::vector<Vec3>(7), .triangle = {0, 0, 0, 1, 1, 2, 3}};
  const std::vector<int> labels{5, 2, 5, 4, 3, 1, 0};
  // Face 1 is tied: the smaller label.
  EXPECT_EQ(face_labels(tetrahedron(), cloud, labels), (std::vector<int>{5, 3, 1, 0}));
}

TEST(FaceLabels, OfEmptyFacesComeFromTheNearestSampleAndNoOutlier) {
  // Face 3 (x + y + z = 1) has no sample; the outlier sits on its centroid.
  const Cloud cloud{
      .points = {{0.3, 0.3, 0.0}, {0.1, 0.0, 0.1}, {0.0, 0.1, 0.1}, {0.34, 0.33, 0.33}},
      .triangle = {0, 1, 2}};
  EXPECT_EQ(face_labels(tetrahedron(), cloud, std::vector<int>{7, 8, 9, 1}),
            (std::vector<int>{7, 8, 9, 7}));
}

TEST(Sampling, AHoleTakesAwayABallOfSamples) {
  const TriangleMesh mesh = tetrahedron();
  const Cloud whole = sample_cloud(mesh, 7, {.points = 5000});
  const Cloud holed = sample_cloud(mesh, 7, {.points = 5000, .hole = 0.1});
  const double reach = 0.1 * std::sqrt(3.0);
  EXPECT_LT(holed.points.size(), whole.points.size());
  EXPECT_EQ(holed.points.size(), holed.triangle.size());
  // What is missing lies within the reach of one of the samples, which is missing too.
  std::vector<Vec3> missing;
  std::size_t next = 0;
  for (const Vec3& p : whole.points) {
    if (next < holed.points.size() && p == holed.points[next]) {
      ++next;
    } else {
      missing.push_back(p);
    }
  }
  EXPECT_EQ(next, holed.points.size());
  const bool found = std::ranges::any_of(missing, [&](const Vec3& center) {
    const auto near = [&](const Vec3& p) { return distance(p, center) < reach; };
    return std::ranges::all_of(missing, near) && std::ranges::none_of(holed.points, near);
  });
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace morsel::bench
