#include <gtest/gtest.h>

#include <morsel/color.hpp>
#include <set>

namespace morsel {
namespace {

TEST(ColorTest, ManyDifferentColours) {
  std::set<Color> colors;
  for (int part = 0; part < 240; ++part) colors.insert(part_color(part));
  EXPECT_EQ(colors.size(), 240U);
  EXPECT_EQ(colors.count(part_color(-1)), 0U);
  EXPECT_EQ(part_color(-1), (Color{160, 160, 160}));
}

}  // namespace
}  // namespace morsel
