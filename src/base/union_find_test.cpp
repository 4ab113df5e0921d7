#include "base/union_find.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/random.hpp"

namespace morsel {
namespace {

TEST(UnionFindTest, StartsAllApart) {
  UnionFind sets(4);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(sets.root(i), i);
  UnionFind none(0);
}

TEST(UnionFindTest, JoinSaysWhetherAnythingChanged) {
  UnionFind sets(4);
  EXPECT_TRUE(sets.join(0, 1));
  EXPECT_TRUE(sets.join(2, 3));
  EXPECT_FALSE(sets.join(1, 0));
  EXPECT_FALSE(sets.join(2, 2));
  EXPECT_NE(sets.root(0), sets.root(2));
  EXPECT_TRUE(sets.join(1, 3));
  for (std::uint32_t i = 1; i < 4; ++i) EXPECT_EQ(sets.root(i), sets.root(0));
}

TEST(UnionFindTest, TheLargerSetKeepsItsRoot) {
  UnionFind sets(5);
  sets.join(3, 4);
  EXPECT_EQ(sets.root(4), 3U);  // equal sizes: the first
  sets.join(0, 4);
  EXPECT_EQ(sets.root(0), 3U);
}

TEST(UnionFindTest, AgreesWithRelabelling) {
  constexpr std::uint32_t kCount = 300;
  UnionFind sets(kCount);
  std::vector<int> label(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) label[i] = static_cast<int>(i);
  Random random(3);
  for (int step = 0; step < 350; ++step) {
    const auto a = static_cast<std::uint32_t>(random.below(kCount));
    const auto b = static_cast<std::uint32_t>(random.below(kCount));
    EXPECT_EQ(sets.join(a, b), label[a] != label[b]);
    const int from = label[b];
    for (int& l : label) l = l == from ? label[a] : l;
  }
  for (std::uint32_t i = 0; i < kCount; ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      ASSERT_EQ(sets.root(i) == sets.root(j), label[i] == label[j]);
    }
  }
}

}  // namespace
}  // namespace morsel
