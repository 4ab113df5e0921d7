#include <gtest/gtest.h>

#include <algorithm>
#include <morsel/error.hpp>
#include <morsel/sketch.hpp>
#include <string>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

Segmentation cut_at(const CutOptions& cut) {
  SegmentOptions options;
  options.cut = cut;
  return segment(shapes::dumbbell(3000), options);
}

Segmentation two_balls() { return cut_at({2, {}}); }

TEST(Sketch, PointsAreThoseOfTheCloudWithTheirParts) {
  const std::vector<Vec3> cloud = shapes::dumbbell(3000);
  SegmentOptions options;
  options.cut.parts = 2;
  options.denoise.rounds = 0;
  const Segmentation result = segment(cloud, options);
  const Sketch sketch = make_sketch(result);
  EXPECT_EQ(sketch.part_count, 2);
  EXPECT_LE(sketch.points.size(), 2000U);
  EXPECT_GE(sketch.points.size(), 1900U);
  EXPECT_TRUE(std::is_sorted(sketch.parts.begin(), sketch.parts.end()));
  EXPECT_NEAR(sketch.step, 6.0 / 255.0, 0.01 * sketch.step);
  int same = 0;
  for (std::size_t i = 0; i < sketch.points.size(); ++i) {
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < cloud.size(); ++k) {
      const double away = distance(cloud[k], sketch.points[i]);
      if (away < distance(cloud[nearest], sketch.points[i])) nearest = k;
    }
    EXPECT_LE(distance(cloud[nearest], sketch.points[i]), 0.9 * sketch.step);
    if (result.labels[nearest] == sketch.parts[i]) ++same;
  }
  EXPECT_GT(same, 1990 * static_cast<int>(sketch.points.size()) / 2000);
}

TEST(Sketch, MergesLeadFromThePartsToOne) {
  const Segmentation result = cut_at({{}, 1.0});
  const Sketch sketch = make_sketch(result);
  ASSERT_GE(sketch.part_count, 2);
  EXPECT_EQ(sketch.merges.size(), static_cast<std::size_t>(sketch.part_count) - 1);
  for (std::size_t i = 0; i < sketch.merges.size(); ++i) {
    EXPECT_LT(sketch.merges[i].a, sketch.merges[i].b);
    EXPECT_GE(sketch.merges[i].ratio, result.parts.merge_ratio);
    const double before = i > 0 ? sketch.merges[i - 1].ratio : 1.0;
    EXPECT_GE(sketch.merges[i].ratio, before);
  }
}

TEST(Sketch, BytesAreShortAndComeBack) {
  const Sketch sketch = make_sketch(two_balls());
  const std::string bytes = encode_sketch(sketch);
  EXPECT_LT(static_cast<double>(bytes.size()), 1.8 * static_cast<double>(sketch.points.size()));
  const Sketch back = decode_sketch(bytes, "test");
  EXPECT_EQ(back.points, sketch.points);
  EXPECT_EQ(back.parts, sketch.parts);
  EXPECT_EQ(back.part_count, sketch.part_count);
  EXPECT_EQ(back.merges.size(), sketch.merges.size());
  EXPECT_EQ(encode_sketch(back), bytes);
}

TEST(Sketch, OddOnesComeBackToo) {
  Sketch sketch;
  EXPECT_EQ(decode_sketch(encode_sketch(sketch), "test").points.size(), 0U);
  sketch.points = {{1, 2, 3}, {1, 2, 3}};
  sketch.parts = {-1, -1};
  sketch.origin = {1, 2, 3};
  const Sketch back = decode_sketch(encode_sketch(sketch), "test");
  EXPECT_EQ(back.points, sketch.points);
  EXPECT_EQ(back.parts, sketch.parts);
}

TEST(Sketch, MorePointsThanAreKeptAreNamed) {
  Sketch sketch;
  sketch.part_count = 1;
  sketch.points.assign(2000, {1, 2, 3});
  sketch.parts.assign(2000, 0);
  sketch.parts[0] = -1;
  EXPECT_EQ(decode_sketch(encode_sketch(sketch), "test").points.size(), 2000U);
  sketch.points.push_back({1, 2, 3});
  sketch.parts.push_back(0);
  try {
    (void)decode_sketch(encode_sketch(sketch), "test");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInput);
    EXPECT_NE(std::string(error.what()).find("more than 2000 points"), std::string::npos)
        << error.what();
  }
}

TEST(Sketch, DoesNotDependOnTheOrderOfThePoints) {
  const std::vector<Vec3> cloud = shapes::dumbbell(3000);
  const std::vector<Vec3> other = shapes::permuted(cloud, shapes::permutation(cloud.size()));
  EXPECT_EQ(encode_sketch(make_sketch(segment(cloud))), encode_sketch(make_sketch(segment(other))));
}

TEST(Sketch, EveryTruncationIsNamed) {
  const std::string bytes = encode_sketch(make_sketch(two_balls()));
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{2}, std::size_t{10}, std::size_t{30}, bytes.size() - 1}) {
    try {
      (void)decode_sketch(bytes.substr(0, length), "test");
      FAIL() << length;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInput);
      EXPECT_TRUE(std::string(error.what()).starts_with("test: ")) << error.what();
    }
  }
  EXPECT_THROW((void)decode_sketch(bytes + "x", "test"), Error);
}

TEST(Sketch, ThumbnailIsAPng) {
  EXPECT_TRUE(draw_thumbnail(make_sketch(two_balls())).starts_with("\x89PNG\r\n\x1a\n"));
  EXPECT_TRUE(draw_thumbnail({}).starts_with("\x89PNG\r\n\x1a\n"));
}

}  // namespace
}  // namespace morsel
