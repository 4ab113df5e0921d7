#include "delaunay/insertion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace morsel {
namespace {

TEST(InsertionRoundsTest, HoldEachPointOnceInAscendingOrder) {
  for (const std::uint32_t n : {0U, 1U, 5U, 1024U, 1025U, 5000U, 100000U}) {
    std::vector<std::uint32_t> all;
    for (const auto& round : insertion_rounds(n)) {
      EXPECT_TRUE(std::ranges::is_sorted(round));
      all.insert(all.end(), round.begin(), round.end());
    }
    std::ranges::sort(all);
    std::vector<std::uint32_t> expected(n);
    std::iota(expected.begin(), expected.end(), 0U);
    EXPECT_EQ(all, expected) << n;
  }
}

TEST(InsertionRoundsTest, FewPointsGoInOneRound) { EXPECT_EQ(insertion_rounds(1024).size(), 1U); }

TEST(InsertionRoundsTest, EachRoundSamplesTheWholeCurve) {
  const auto rounds = insertion_rounds(100000);
  ASSERT_GE(rounds.size(), 4U);
  for (std::size_t r = 1; r < rounds.size(); ++r) {
    std::size_t before = 0;
    for (std::size_t s = 0; s < r; ++s) before += rounds[s].size();
    EXPECT_NEAR(static_cast<double>(rounds[r].size()) / static_cast<double>(before), 3.0, 0.5) << r;
    // About as many in either half of the curve.
    const auto middle = std::ranges::lower_bound(rounds[r], 50000U) - rounds[r].begin();
    EXPECT_NEAR(static_cast<double>(middle) / static_cast<double>(rounds[r].size()), 0.5, 0.05)
        << r;
  }
}

}  // namespace
}  // namespace morsel
