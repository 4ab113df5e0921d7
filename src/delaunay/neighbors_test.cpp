#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <morsel/delaunay.hpp>
#include <set>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

using shapes::Points;

std::vector<double> brute_force(const Points& points) {
  std::vector<double> lambda;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<double> distances;
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (j != i) distances.push_back(distance(points[i], points[j]));
    }
    const std::size_t count = std::min<std::size_t>(3, distances.size());
    std::partial_sort(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(count),
                      distances.end());
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) sum += distances[k];
    lambda.push_back(count > 0 ? sum / static_cast<double>(count) : 0.0);
  }
  return lambda;
}

void expect_as_brute_force(const Points& points) {
  const DelaunayComplex complex = triangulate(points);
  const std::vector<double> expected = brute_force(complex.vertices);
  for (const int threads : {1, 2}) {
    const std::vector<double> lambda = mean_neighbor_distance(complex, threads);
    ASSERT_EQ(lambda.size(), expected.size());
    for (std::size_t i = 0; i < lambda.size(); ++i) {
      EXPECT_NEAR(lambda[i], expected[i], 1e-12 * expected[i]) << i;
    }
  }
}

TEST(NeighborsTest, RandomCloud) { expect_as_brute_force(shapes::cube_cloud(3000)); }

TEST(NeighborsTest, Surface) {
  expect_as_brute_force(shapes::noisy(shapes::torus(1500, 2.0, 0.5), 0.01));
}

TEST(NeighborsTest, Clusters) {
  Points points;
  Random random(2);
  for (int cluster = 0; cluster < 40; ++cluster) {
    const Vec3 center = 100.0 * shapes::random_in_cube(random);
    const double size = std::pow(10.0, -6.0 * random.uniform());
    for (int i = 0; i < 2 + cluster % 7; ++i) {
      points.push_back(center + size * shapes::random_in_cube(random));
    }
  }
  expect_as_brute_force(points);
}

TEST(NeighborsTest, Grid) { expect_as_brute_force(shapes::grid(8)); }

TEST(NeighborsTest, FewPoints) {
  expect_as_brute_force({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}});
  expect_as_brute_force({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {1, 1, 1}});
}

TEST(NeighborsTest, VertexCellsAreTheCellsOfEachVertex) {
  const DelaunayComplex complex = triangulate(shapes::cube_cloud(300));
  const VertexCells cells = find_vertex_cells(complex);
  ASSERT_EQ(cells.offsets.size(), complex.vertices.size() + 1);
  EXPECT_EQ(cells.cells.size(), 4 * complex.cell_count());
  std::vector<std::set<std::uint32_t>> expected(complex.vertices.size());
  for (std::uint32_t c = 0; c < complex.cell_count(); ++c) {
    for (const std::uint32_t v : complex.cells[c]) expected[v].insert(c);
  }
  for (std::size_t v = 0; v < expected.size(); ++v) {
    const auto of = cells.of(v);
    EXPECT_TRUE(std::ranges::equal(of, expected[v]));  // also ascending
  }
}

TEST(NeighborsTest, NothingToMeasure) {
  const DelaunayComplex empty = triangulate({});
  EXPECT_TRUE(mean_neighbor_distance(empty).empty());
}

}  // namespace
}  // namespace morsel
