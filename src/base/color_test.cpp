#include <gtest/gtest.h>

#include <morsel/color.hpp>
#include <set>

namespace morsel {
namespace {

TEST(ColorTest, TwentyFourDifferentColoursThenTheyRepeat) {
  std::set<Color> colors;
  for (int part = 0; part < 24; ++part) colors.insert(part_color(part));
  EXPECT_EQ(colors.size(), 24U);
  EXPECT_EQ(part_color(24), part_color(0));
  EXPECT_EQ(colors.count(part_color(-1)), 0U);
  EXPECT_EQ(part_color(-1), (Color{160, 160, 160}));
}

}  // namespace
}  // namespace morsel
