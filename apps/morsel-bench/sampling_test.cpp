#include "sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <morsel/error.hpp>

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

}  // namespace
}  // namespace morsel::bench
