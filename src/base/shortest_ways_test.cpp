#include "base/shortest_ways.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace morsel {
namespace {

TEST(ShortestWaysTest, GoAroundWhatIsLonger) {
  // 0 - 1 - 2 in steps of 1 and 2, 0 - 2 directly 4; 3 is alone.
  const Graph graph{{{1, 1.0}, {2, 4.0}}, {{0, 1.0}, {2, 2.0}}, {{0, 4.0}, {1, 2.0}}, {}};
  const double none = std::numeric_limits<double>::infinity();
  EXPECT_EQ(shortest_ways(graph, 0), (std::vector<double>{0.0, 1.0, 3.0, none}));
  EXPECT_EQ(shortest_ways(graph, 2), (std::vector<double>{3.0, 2.0, 0.0, none}));
  EXPECT_EQ(shortest_ways(graph, 3), (std::vector<double>{none, none, none, 0.0}));
}

}  // namespace
}  // namespace morsel
