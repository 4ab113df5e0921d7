#include <gtest/gtest.h>

#include <cmath>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

Segmentation segmented(const shapes::Points& points) {
  SegmentOptions options;
  options.threads = 1;
  return segment(points, options);
}

TEST(ExplainScore, TheTermsMakeTheScore) {
  const Signature a = make_signature(segmented(shapes::dumbbell(3000, 0.4)));
  const Signature b = make_signature(segmented(shapes::torus(3000, 2.0, 0.7)));
  const auto terms = explain_score(a, b);
  ASSERT_EQ(terms.size(), 5U);
  double distance = 0.0;
  double weights = 0.0;
  for (const ScoreTerm& term : terms) {
    EXPECT_GT(term.distance, 0.0) << term.name;
    distance += term.weight * term.distance;
    weights += term.weight;
  }
  EXPECT_NEAR(weights, 1.0, 1e-12);
  EXPECT_NEAR(std::exp(-distance), match_score(a, b), 1e-12);
  for (const ScoreTerm& term : explain_score(a, a)) EXPECT_EQ(term.distance, 0.0);
  EXPECT_TRUE(explain_score(a, {}).empty());
}

TEST(OnTarget, PointsAndPartsGoWhereTheMatchSays) {
  Match match;
  match.target_from_source = {0, -2, 0, 1, 2, 0, 0, 0, 0, 0, 2, -1, 0, 0, 0, 1};
  match.matched = {{.target = 3, .source = 0, .contribution = 1.0}};
  const auto points = on_target(match, std::vector<Vec3>{{1, 2, 3}});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0], (Vec3{-3, 2, 5}));
  EXPECT_EQ(parts_on_target(match, std::vector<int>{0, 1, -1, 0}),
            (std::vector<int>{3, -1, -1, 3}));
}

TEST(OnTarget, AShapeLiesOnItself) {
  const shapes::Points points = shapes::dumbbell(3000, 0.4);
  const Segmentation s = segmented(points);
  const Signature signature = make_signature(s);
  const Match match = morsel::match(signature, signature);
  const auto moved = on_target(match, points);
  double farthest = 0.0;
  for (const Vec3& p : moved) {
    double nearest = 1e9;
    for (std::size_t i = 0; i < points.size(); i += 7) {
      nearest = std::min(nearest, distance(p, points[i]));
    }
    farthest = std::max(farthest, nearest);
  }
  EXPECT_LT(farthest, 0.5);
}

TEST(MatchJson, HoldsAll) {
  Match match;
  match.score = 0.5;
  match.mirrored = true;
  match.matched = {{.target = 1, .source = 2, .contribution = 0.25}};
  match.unmatched_source = {0};
  const auto json = nlohmann::json::parse(to_json(match));
  EXPECT_EQ(json["score"], 0.5);
  EXPECT_EQ(json["mirrored"], true);
  EXPECT_EQ(json["target_from_source"].size(), 16U);
  EXPECT_EQ(json["matched"][0]["contribution"], 0.25);
  EXPECT_TRUE(json["unmatched_target"].empty());
  EXPECT_EQ(json["unmatched_source"][0], 0);
}

}  // namespace
}  // namespace morsel
