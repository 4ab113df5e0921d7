#include "interior/poles.hpp"

#include <gtest/gtest.h>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

// Four corners of a cube that bound a regular tetrahedron around its middle: one cell.
const DelaunayComplex kTetrahedron =
    triangulate(shapes::Points{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});

TEST(PolesTest, HullNormalsPointOutwards) {
  const std::vector<Vec3> normals = hull_normals(kTetrahedron);
  ASSERT_EQ(normals.size(), 4U);
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_NEAR(cosine(normals[v], kTetrahedron.vertices[v]), 1.0, 1e-12);
  }
}

TEST(PolesTest, WithinTheHullThereAreNoNormals) {
  shapes::Points points = shapes::cube_cloud(200);
  points.push_back({0.5, 0.5, 0.5});
  const DelaunayComplex complex = triangulate(points);
  EXPECT_EQ(hull_normals(complex)[complex.vertex_of_point.back()], Vec3());
}

TEST(PolesTest, TheOppositeBallLiesOnTheOtherSide) {
  const VertexCells vertex_cells = find_vertex_cells(kTetrahedron);
  const auto any = [](std::uint32_t) { return true; };
  const auto none = [](std::uint32_t) { return false; };
  const auto opposite = [&](std::uint32_t v, const Vec3& direction, const auto& may) {
    return largest_opposite_ball(kTetrahedron, vertex_cells, v, direction, may);
  };
  for (std::uint32_t v = 0; v < 4; ++v) {
    const Vec3& outwards = kTetrahedron.vertices[v];
    EXPECT_EQ(largest_ball(kTetrahedron, vertex_cells, v, any), 0U);
    EXPECT_EQ(largest_ball(kTetrahedron, vertex_cells, v, none), kNoCell);
    EXPECT_EQ(opposite(v, outwards, any), 0U);
    EXPECT_EQ(opposite(v, outwards, none), kNoCell);
    EXPECT_EQ(opposite(v, -1.0 * outwards, any), kNoCell);
  }
}

}  // namespace
}  // namespace morsel
