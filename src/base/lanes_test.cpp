#include "base/lanes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace morsel {
namespace {

TEST(LanesTest, FourSpotsAreTurnedIntoLanes) {
  const std::vector<Spot> spots{{0, 1, 2}, {10, 11, 12}, {20, 21, 22}, {30, 31, 32}, {40, 41, 42}};
  const std::vector<std::uint32_t> indices{3, 0, 4, 1};
  const Lanes3 found = gather(spots.data(), indices.data());
  for (int lane = 0; lane < 4; ++lane) {
    const Spot& spot = spots[indices[lane]];
    EXPECT_EQ(found.x[lane], spot.x);
    EXPECT_EQ(found.y[lane], spot.y);
    EXPECT_EQ(found.z[lane], spot.z);
  }
}

TEST(LanesTest, ProductsOfDirections) {
  const Lanes3 difference = all_lanes(Spot{5, 7, 9}) - all_lanes(Spot{1, 2, 3});
  const Lanes product = dot(difference, all_lanes(Spot{1, 10, 100}));
  for (int lane = 0; lane < 4; ++lane) EXPECT_EQ(product[lane], 654.0F);
}

TEST(LanesTest, SignsLaneByLane) {
  const Lanes values{-1.5F, 2.5F, -0.0F, 3.0F};
  const Lanes positive = abs(values);
  const Lanes turned = with_sign(all_lanes(2.0F), values);
  const Lanes cut = not_negative(values);
  const float expected[3][4] = {{1.5F, 2.5F, 0.0F, 3.0F}, {-2, 2, -2, 2}, {0, 2.5F, 0, 3}};
  for (int lane = 0; lane < 4; ++lane) {
    EXPECT_EQ(positive[lane], expected[0][lane]);
    EXPECT_EQ(turned[lane], expected[1][lane]);
    EXPECT_EQ(cut[lane], expected[2][lane]);
  }
  EXPECT_EQ(sum(values), 4.0F);
}

}  // namespace
}  // namespace morsel
