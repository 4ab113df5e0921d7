#include "segment/rank.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace morsel {
namespace {

constexpr double kNatural = 1.5;

std::vector<Merge> ranked(std::vector<Merge> merges, const std::vector<std::uint32_t>& points) {
  rank_merges(points, kNatural, merges);
  return merges;
}

// The ratio of the merge of these two pieces.
double ratio_of(const std::vector<Merge>& merges, std::uint32_t a, std::uint32_t b) {
  const auto found = std::ranges::find_if(
      merges, [&](const Merge& m) { return std::minmax(m.a, m.b) == std::minmax(a, b); });
  return found == merges.end() ? 0.0 : found->ratio;
}

TEST(RankTest, RatiosStayOnTheirSideOfTheNaturalOne) {
  const auto merges =
      ranked({{1.2, 0, 1, true}, {1.4, 2, 3, true}, {1.9, 0, 2, true}}, {100, 100, 100, 100});
  EXPECT_LT(ratio_of(merges, 0, 1), kNatural);
  EXPECT_LT(ratio_of(merges, 2, 3), kNatural);
  EXPECT_GT(ratio_of(merges, 0, 2), kNatural);
}

TEST(RankTest, OfTwoDearMergesTheLargerIsUndoneFirst) {
  const auto merges =
      ranked({{2.0, 0, 1, true}, {2.001, 2, 3, true}, {3.0, 0, 2, true}}, {500, 500, 20, 20});
  EXPECT_GT(ratio_of(merges, 0, 1), ratio_of(merges, 2, 3));
}

TEST(RankTest, OfTwoCheapMergesTheSmallerIsUndoneFirst) {
  const auto merges =
      ranked({{1.2, 0, 1, true}, {1.201, 2, 3, true}, {3.0, 0, 2, true}}, {20, 20, 500, 500});
  EXPECT_GT(ratio_of(merges, 0, 1), ratio_of(merges, 2, 3));
}

// Two balls of 500 points hang by a collar that nobody would cut off by itself: the dear merge
// below is not worth less because the one above it is small.
TEST(RankTest, WhatHidesADearMergeIsUndoneWithIt) {
  const auto merges = ranked({{2.5, 0, 1, true}, {2.6, 0, 2, true}}, {500, 500, 10});
  EXPECT_NEAR(ratio_of(merges, 0, 2) / ratio_of(merges, 0, 1), 1.0, 1e-6);
  EXPECT_GT(ratio_of(merges, 0, 2), ratio_of(merges, 0, 1));
}

TEST(RankTest, RatiosRiseAndWhatIsAlwaysCarriedOutComesFirst) {
  const auto merges =
      ranked({{1.1, 0, 1, true}, {1.3, 2, 3, false}, {1.6, 0, 2, true}, {1.7, 0, 4, true}},
             {100, 100, 100, 1, 100});
  ASSERT_EQ(merges.size(), 4U);
  EXPECT_FALSE(merges[0].significant);
  EXPECT_GE(merges[0].ratio, 1.0);
  for (std::size_t m = 1; m < merges.size(); ++m) {
    EXPECT_LT(merges[m - 1].ratio, merges[m].ratio);
    EXPECT_TRUE(merges[m].significant);
  }
}

TEST(RankTest, NothingToRank) {
  EXPECT_TRUE(ranked({}, {}).empty());
  EXPECT_TRUE(ranked({}, {5}).empty());
}

}  // namespace
}  // namespace morsel
