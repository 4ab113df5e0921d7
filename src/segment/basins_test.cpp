#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/union_find.hpp"
#include "delaunay/balls.hpp"
#include "segment/test_stages.hpp"

namespace morsel {
namespace {

using shapes::Points;
using shapes::Stages;

class BasinsTest : public ::testing::TestWithParam<int> {
 protected:
  static Stages stages() {
    switch (GetParam()) {
      case 0:
        return shapes::run_stages(shapes::dumbbell(5000));
      case 1:
        return shapes::run_stages(shapes::noisy(shapes::torus(5000, 2.0, 0.7), 0.02));
      default:
        return shapes::run_stages(shapes::box(4000, {1, 2, 3}));
    }
  }
};

// Whether a cell flows across its facet i, computed from the definition.
bool flows(const Stages& s, std::uint32_t cell, int i) {
  const std::uint32_t next = s.complex.neighbors[cell][i];
  if (next == kNoCell || s.interior.side[next] != CellSide::kInner) return false;
  const auto& corners = s.complex.cells[cell];
  const auto& v = s.complex.vertices;
  return inside_equatorial_sphere(v[corners[kFacetSlots[i][0]]], v[corners[kFacetSlots[i][1]]],
                                  v[corners[kFacetSlots[i][2]]], v[corners[i]]);
}

TEST_P(BasinsTest, PartitionTheInnerCells) {
  const Stages s = stages();
  ASSERT_EQ(s.basins.basin_of_cell.size(), s.complex.cell_count());
  ASSERT_GT(s.basins.count(), 0U);
  std::vector<std::size_t> cells(s.basins.count(), 0);
  for (std::uint32_t c = 0; c < s.complex.cell_count(); ++c) {
    const std::uint32_t b = s.basins.basin_of_cell[c];
    ASSERT_EQ(b != kNoBasin, s.interior.side[c] == CellSide::kInner);
    if (b == kNoBasin) continue;
    ASSERT_LT(b, s.basins.count());
    ++cells[b];
  }
  for (std::uint32_t b = 0; b < s.basins.count(); ++b) {
    EXPECT_GT(cells[b], 0U);
    EXPECT_EQ(s.basins.basin_of_cell[s.basins.maximum[b]], b);
  }
}

TEST_P(BasinsTest, RadiusGrowsAlongTheFlow) {
  const Stages s = stages();
  for (std::uint32_t c = 0; c < s.complex.cell_count(); ++c) {
    if (s.interior.side[c] != CellSide::kInner) continue;
    for (int i = 0; i < 4; ++i) {
      if (!flows(s, c, i)) continue;
      EXPECT_GE(s.complex.radii[s.complex.neighbors[c][i]], s.complex.radii[c] * (1.0 - 1e-9));
    }
  }
}

// Every cell that is no stray leads along the flow to the maximum of its basin, the largest of
// those that it can reach; each basin is connected.
TEST_P(BasinsTest, CellsReachTheirMaximumAlongTheFlow) {
  const Stages s = stages();
  std::vector<std::uint32_t> best(s.complex.cell_count(), kNoBasin);
  for (std::uint32_t b = 0; b < s.basins.count(); ++b) {  // larger maxima first
    std::vector<std::uint32_t> stack{s.basins.maximum[b]};
    if (best[s.basins.maximum[b]] == kNoBasin) best[s.basins.maximum[b]] = b;
    while (!stack.empty()) {
      const std::uint32_t c = stack.back();
      stack.pop_back();
      for (const std::uint32_t d : s.complex.neighbors[c]) {
        if (d == kNoCell || best[d] != kNoBasin || s.interior.side[d] != CellSide::kInner) continue;
        for (int i = 0; i < 4; ++i) {
          if (s.complex.neighbors[d][i] != c || !flows(s, d, i)) continue;
          best[d] = b;
          stack.push_back(d);
          break;
        }
      }
    }
  }
  std::size_t strays = 0;
  for (std::uint32_t c = 0; c < s.complex.cell_count(); ++c) {
    if (s.interior.side[c] != CellSide::kInner) continue;
    if (best[c] == kNoBasin) {
      ++strays;
      continue;
    }
    EXPECT_EQ(s.basins.basin_of_cell[c], best[c]);
    EXPECT_LE(s.complex.radii[c], s.complex.radii[s.basins.maximum[best[c]]] * (1.0 + 1e-9));
  }
  EXPECT_LE(strays, s.basins.stray_cells);
}

TEST_P(BasinsTest, EachBasinIsConnected) {
  const Stages s = stages();
  UnionFind groups(s.complex.cell_count());
  for (std::uint32_t c = 0; c < s.complex.cell_count(); ++c) {
    const std::uint32_t b = s.basins.basin_of_cell[c];
    if (b == kNoBasin) continue;
    for (const std::uint32_t d : s.complex.neighbors[c]) {
      if (d != kNoCell && s.basins.basin_of_cell[d] == b) groups.join(c, d);
    }
  }
  for (std::uint32_t c = 0; c < s.complex.cell_count(); ++c) {
    const std::uint32_t b = s.basins.basin_of_cell[c];
    if (b == kNoBasin) continue;
    EXPECT_EQ(groups.root(c), groups.root(s.basins.maximum[b]));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, BasinsTest, ::testing::Range(0, 3));

TEST(NoBasinsTest, NothingInside) {
  const Basins none = find_basins({}, {});
  EXPECT_EQ(none.count(), 0U);
}

}  // namespace
}  // namespace morsel
