#include "interior/bulge.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "base/neighborhoods.hpp"
#include "base/test_shapes.hpp"

namespace morsel {
namespace {

using shapes::Points;

constexpr double kUnitBall = 4.0 / 3.0 * std::numbers::pi;

struct Volumes {
  double cells = 0.0;
  double bulges = 0.0;
};

// Of the inside of `kept`, which lie on the surface that the samples show.
Volumes volumes_of(const Points& kept, const Points& samples) {
  const DelaunayComplex complex = triangulate(kept);
  const Interior interior =
      find_interior(complex, find_vertex_cells(complex), mean_neighbor_distance(complex));
  std::vector<std::uint32_t> vertex = find_nearest(kept, samples, 1);
  for (std::uint32_t& v : vertex) v = complex.vertex_of_point[v];
  const std::vector<double> bulges = find_bulges(complex, interior.side, {samples, vertex});
  Volumes volumes;
  for (std::size_t c = 0; c < bulges.size(); ++c) {
    if (interior.side[c] == CellSide::kInner) {
      volumes.cells += cell_volume(complex, c);
      volumes.bulges += bulges[c];
    } else {
      EXPECT_EQ(bulges[c], 0.0);
    }
  }
  return volumes;
}

TEST(BulgeTest, SamplesSayWhatTheTrianglesCutOff) {
  const Volumes volumes = volumes_of(shapes::even_sphere(800), shapes::sphere(20000));
  EXPECT_LT(volumes.cells, 0.993 * kUnitBall);
  EXPECT_NEAR(volumes.cells + volumes.bulges, kUnitBall, 0.001 * kUnitBall);
}

TEST(BulgeTest, NothingAboveFlatFacesAndBesideThem) {
  const Volumes volumes =
      volumes_of(shapes::box(6000, {2, 2, 2}), shapes::box(20000, {2, 2, 2}, 5));
  EXPECT_NEAR(volumes.cells + volumes.bulges, 8.0, 0.02);
  EXPECT_LE(std::abs(volumes.bulges), 0.08);
}

TEST(BulgeTest, SamplesOfTheOtherSheetDoNotCount) {
  constexpr double kThin = 0.02;  // the spacing is about that
  const Volumes volumes =
      volumes_of(shapes::box(8000, {1, 1, kThin}), shapes::box(20000, {1, 1, kThin}, 5));
  EXPECT_NEAR(volumes.bulges, 0.0, 0.1 * kThin);
}

TEST(BulgeTest, NoSamples) {
  const Volumes volumes = volumes_of(shapes::even_sphere(300), {});
  EXPECT_GT(volumes.cells, 0.0);
  EXPECT_EQ(volumes.bulges, 0.0);
}

}  // namespace
}  // namespace morsel
