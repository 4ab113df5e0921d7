#include "signature/landmarks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

// The plain rule: each next one is farthest from all chosen.
std::vector<Vec3> farthest_first(const shapes::Points& points, std::size_t count) {
  std::vector<double> squared(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) squared[i] = squared_norm(points[i]);
  std::vector<Vec3> chosen;
  while (chosen.size() < count) {
    const auto at = std::ranges::max_element(squared) - squared.begin();
    if (chosen.empty()) squared.assign(points.size(), std::numeric_limits<double>::infinity());
    chosen.push_back(points[at]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      squared[i] = std::min(squared[i], squared_distance(points[i], chosen.back()));
    }
  }
  return chosen;
}

TEST(LandmarksTest, EqualThePlainRule) {
  const shapes::Points points = shapes::torus(2000, 2.0, 0.7);
  const Landmarks marks = find_landmarks(points, {}, 40);
  const std::vector<Vec3> chosen = farthest_first(points, 40);
  ASSERT_EQ(marks.count(), 40U);
  double total = 0.0;
  for (const double weight : marks.weight) total += weight;
  EXPECT_NEAR(total, 1.0, 1e-12);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double best = std::numeric_limits<double>::infinity();
    for (const Vec3& c : chosen) best = std::min(best, distance(points[i], c));
    EXPECT_DOUBLE_EQ(distance(points[i], chosen[marks.owner[i]]), best);
  }
}

TEST(LandmarksTest, NormalsOfASphere) {
  const Landmarks marks = find_landmarks(shapes::even_sphere(20000), {}, 200);
  for (std::size_t k = 0; k < marks.count(); ++k) {
    const double facing =
        std::abs(dot(marks.normal[k], marks.position[k])) / norm(marks.position[k]);
    EXPECT_GT(facing, 0.99);
  }
}

TEST(LandmarksTest, FewPoints) {
  EXPECT_EQ(find_landmarks({}, {}, 5).count(), 0U);
  const shapes::Points two{{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(find_landmarks(two, {}, 5).count(), 2U);
}

}  // namespace
}  // namespace morsel
