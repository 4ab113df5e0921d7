#include "base/neighbor_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

using shapes::Points;

TEST(NeighborSearchTest, FindsWhatMeasuringAllFinds) {
  for (const double scale : {1e-170, 1.0, 1e170}) {
    const Points points = shapes::scaled(shapes::cube_cloud(700), scale);
    const NeighborSearch search(points);
    for (std::uint32_t i = 0; i < points.size(); i += 50) {
      std::vector<std::pair<double, std::uint32_t>> all;
      for (std::uint32_t j = 0; j < points.size(); ++j) {
        if (j != i)
          all.emplace_back(distance((1.0 / scale) * points[i], (1.0 / scale) * points[j]), j);
      }
      std::ranges::sort(all);
      for (const std::size_t size : {1, 12, 40, 63}) {
        std::vector<std::uint32_t> nearest(size);
        const double reach = search.find(i, nearest);
        EXPECT_NEAR(reach / scale, all[size - 1].first, 1e-12);
        for (std::size_t k = 0; k < size; ++k) EXPECT_EQ(nearest[k], all[k].second);
      }
    }
  }
}

}  // namespace
}  // namespace morsel
