#include <gtest/gtest.h>

#include <morsel/morsel.hpp>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

TEST(MatchTest, AShapeIsLikeItself) {
  const Signature signature = segment(shapes::dumbbell(5000)).signature;
  const Match m = match(signature, signature);
  EXPECT_EQ(m.score, 1.0);
  EXPECT_EQ(m.matched.size(), signature.parts.size());
  EXPECT_TRUE(m.unmatched_target.empty());
}

}  // namespace
}  // namespace morsel
