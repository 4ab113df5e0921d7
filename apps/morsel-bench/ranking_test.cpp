#include "ranking.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace morsel::bench {
namespace {

TEST(RankTest, CountedByHand) {
  const std::vector<std::string> categories{"a", "a", "a", "b"};
  // Query 0 sees 1, 3, 2; query 1 sees 0, 2, 3; query 2 sees 3, 0, 1; query 3 is alone.
  const std::vector<double> scores{1.0, 0.9, 0.1, 0.5,  //
                                   0.9, 1.0, 0.8, 0.2,  //
                                   0.5, 0.4, 1.0, 0.9,  //
                                   0.0, 0.0, 0.0, 1.0};
  const Retrieval r = rank(scores, categories, std::vector<std::size_t>{0, 1, 2, 3});
  EXPECT_DOUBLE_EQ(r.nearest, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(r.first_tier, (0.5 + 1.0 + 0.5) / 3.0);
  EXPECT_DOUBLE_EQ(r.second_tier, 1.0);
  const double third = 1.0 / std::log2(3.0);
  EXPECT_DOUBLE_EQ(r.gain, ((1.0 + third) / 2.0 + 1.0 + (1.0 + third) / 2.0) / 3.0);
}

TEST(RankTest, TiesGoByIndexAndSelfIsNoHit) {
  const std::vector<std::string> categories{"a", "b", "a"};
  const std::vector<double> scores(9, 0.5);
  const Retrieval r = rank(scores, categories, std::vector<std::size_t>{0, 1, 2});
  EXPECT_DOUBLE_EQ(r.nearest, 0.5);  // query 0 sees 1 first, query 2 sees 0 first
}

TEST(RankTest, AnyShapesInAnyOrderMayAsk) {
  const std::vector<std::string> categories{"a", "b", "a", "b"};
  const std::vector<double> scores{0.1, 0.2, 0.3, 0.4,    // of shape 3: sees 2, 1, 0
                                   0.1, 0.2, 0.9, 0.05};  // of shape 2: sees 1, 0, 3
  const Retrieval r = rank(scores, categories, std::vector<std::size_t>{3, 2});
  EXPECT_DOUBLE_EQ(r.nearest, 0.0);
  EXPECT_DOUBLE_EQ(r.second_tier, 1.0);
  EXPECT_DOUBLE_EQ(r.gain, 1.0);
}

}  // namespace
}  // namespace morsel::bench
