#include "serve/stored_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <morsel/morsel.hpp>

#include "base/test_shapes.hpp"

namespace morsel::serve {
namespace {

const Segmentation& dumbbell() {
  static const Segmentation s = [] {
    SegmentOptions options;
    options.cut.parts = 2;
    return segment(shapes::noisy(shapes::dumbbell(6000), 0.005), options);
  }();
  return s;
}

ShapeData data_of(const Segmentation& s) {
  ShapeData data;
  data.points = s.labels.size();
  data.signature = make_signature(s);
  data.sketch = make_sketch(s);
  return data;
}

TEST(StoredTree, ItsFinestCutIsTheStoredOne) {
  const Segmentation& s = dumbbell();
  const MergeTree tree = tree_of(data_of(s));
  const Parts parts = cut(tree, {.parts = {}, .merge_ratio = 1.0});
  ASSERT_EQ(parts.parts.size(), s.parts.parts.size());
  double volume = 0.0;
  double all = 0.0;
  for (const Part& part : s.parts.parts) volume += part.volume;
  for (const Part& part : parts.parts) all += part.volume;
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    const Part& stored = parts.parts[i];
    const Part& part = s.parts.parts[i];
    EXPECT_NEAR(stored.volume / all, part.volume / volume, 1e-3);
    EXPECT_LT(distance(stored.center, part.center), 0.01);
    EXPECT_NEAR(stored.ball_radius, part.ball_radius, 0.01);
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_NEAR(stored.covariance[k], part.covariance[k], 0.01);
    }
    ASSERT_EQ(stored.neighbors.size(), part.neighbors.size());
    EXPECT_NEAR(stored.neighbors[0].neck_radius, part.neighbors[0].neck_radius, 0.01);
    const double share = static_cast<double>(tree.point_count[i]) / 6000.0;
    EXPECT_NEAR(share, static_cast<double>(part.point_count) / 6000.0, 0.03);
  }
  EXPECT_EQ(tree.levels().front().parts, 1U);
}

TEST(StoredTree, PartsThatTheSignatureLeftOutComeFromTheirPoints) {
  ShapeData data = data_of(dumbbell());
  const MergeTree whole = tree_of(data);
  const double kept = data.signature.parts[0].weight;
  data.signature.parts.resize(1);
  data.signature.parts[0].neighbors.clear();
  const MergeTree tree = tree_of(data);
  ASSERT_EQ(tree.moments.size(), 2U);
  EXPECT_EQ(tree.ball_radius[1], 0.0);
  EXPECT_NEAR(tree.moments[1].volume / (tree.moments[0].volume + tree.moments[1].volume),
              1.0 - kept, 1e-9);
  EXPECT_LT(distance(tree.ball_center[1], whole.ball_center[1]), 0.2);
}

TEST(StoredTree, NoInsideIsNoPart) {
  ShapeData data;
  data.points = 4;
  data.signature.size = 1.0;
  data.sketch.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  data.sketch.parts = {-1, -1, -1, -1};
  const MergeTree tree = tree_of(data);
  EXPECT_TRUE(tree.moments.empty());
  EXPECT_EQ(tree.component_count, 0U);
  EXPECT_EQ(tree.piece_of_point, (std::vector<std::uint32_t>(4, kNoBasin)));
}

}  // namespace
}  // namespace morsel::serve
