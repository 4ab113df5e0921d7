#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "io/test_files.hpp"

namespace morsel::io {
namespace {

// The unit cube, moved, with a vertex far away that no face uses.
TriangleMesh cube(const Vec3& at, double side) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner{static_cast<double>(i & 1), static_cast<double>((i >> 1) & 1),
                      static_cast<double>(i >> 2)};
    mesh.vertices.push_back(at + side * corner);
  }
  mesh.vertices.push_back({1e9, 1e9, 1e9});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(SampleTest, PointsPerTriangleFollowTheAreas) {
  // Areas 0.5, 0 and 4.5.
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {8, 0, 0}, {5, 3, 0}},
                          {{0, 1, 2}, {0, 1, 1}, {3, 4, 5}}};
  constexpr std::size_t kCount = 100000;
  const SurfaceSample sample = sample_surface(mesh, {.count = kCount});
  std::vector<double> share(3);
  for (const std::uint32_t t : sample.triangle) share[t] += 1.0 / kCount;
  EXPECT_NEAR(share[0], 0.1, 0.004);
  EXPECT_EQ(share[1], 0.0);
  EXPECT_NEAR(share[2], 0.9, 0.004);
}

TEST(SampleTest, PointsAreUniformWithinATriangle) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  constexpr int kCells = 8;
  std::vector<int> counts(kCells * kCells);
  constexpr std::size_t kCount = 64000;
  for (const Vec3& p : sample_surface(mesh, {.count = kCount}).points) {
    ASSERT_TRUE(p.x >= 0 && p.y >= 0 && p.x + p.y <= 1 + 1e-15 && p.z == 0);
    ++counts[static_cast<std::size_t>(p.x * kCells) * kCells +
             static_cast<std::size_t>(p.y * kCells)];
  }
  // 28 whole cells of area 1/64 and 8 halves: chi-square with 35 degrees of freedom, 99.99 %.
  double chi_square = 0.0;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; i + j < kCells; ++j) {
      const double expected = kCount / 64.0 * 2.0 * (i + j == kCells - 1 ? 0.5 : 1.0);
      const double difference = counts[static_cast<std::size_t>(i * kCells + j)] - expected;
      chi_square += difference * difference / expected;
    }
  }
  EXPECT_LT(chi_square, 76.0);
}

TEST(SampleTest, NoiseIsAFractionOfTheDiagonalAndMovesTheSamePoints) {
  const TriangleMesh mesh = cube({0, 0, 0}, 2.0);
  const SurfaceSample clean = sample_surface(mesh, {.count = 50000});
  const SurfaceSample noisy = sample_surface(mesh, {.count = 50000, .noise = 0.01});
  EXPECT_EQ(clean.triangle, noisy.triangle);
  Vec3 squares;
  for (std::size_t i = 0; i < clean.points.size(); ++i) {
    const Vec3 d = noisy.points[i] - clean.points[i];
    squares = squares + Vec3{d.x * d.x, d.y * d.y, d.z * d.z};
  }
  const double sigma = 0.01 * 2.0 * std::sqrt(3.0);
  for (const double sum : {squares.x, squares.y, squares.z}) {
    EXPECT_NEAR(std::sqrt(sum / 50000.0), sigma, 0.01 * sigma);
  }
}

TEST(SampleTest, IsTheSameForASeedAndAnotherForAnother) {
  const TriangleMesh mesh = cube({1e6, 1e6, 1e6}, 1.0);
  const SurfaceSample first = sample_surface(mesh, {.count = 1000, .noise = 0.1, .seed = 5});
  EXPECT_EQ(first.points, sample_surface(mesh, {.count = 1000, .noise = 0.1, .seed = 5}).points);
  EXPECT_NE(first.points, sample_surface(mesh, {.count = 1000, .noise = 0.1, .seed = 6}).points);
  // For ever: recorded from the first version.
  const SurfaceSample pinned = sample_surface(cube({0, 0, 0}, 1.0), {.count = 2, .seed = 1});
  EXPECT_EQ(pinned.triangle, (std::vector<std::uint32_t>{9, 8}));
}

TEST(SampleTest, ScalesWithoutOverOrUnderflow) {
  const SurfaceSample unit = sample_surface(cube({0, 0, 0}, 1.0), {.count = 100});
  for (const double side : {0x1p-600, 0x1p600}) {
    const SurfaceSample scaled = sample_surface(cube({0, 0, 0}, side), {.count = 100});
    EXPECT_EQ(scaled.triangle, unit.triangle);
    EXPECT_EQ(scaled.points[7], side * unit.points[7]);
  }
}

TEST(SampleTest, VolumeHasASignAndSurvivesDistance) {
  EXPECT_DOUBLE_EQ(signed_volume(cube({0, 0, 0}, 2.0)), 8.0);
  EXPECT_DOUBLE_EQ(signed_volume(cube({1e6, -1e6, 1e6}, 2.0)), 8.0);
  TriangleMesh inverted = cube({0, 0, 0}, 1.0);
  for (auto& triangle : inverted.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_DOUBLE_EQ(signed_volume(inverted), -1.0);
  EXPECT_EQ(signed_volume({}), 0.0);
}

TEST(SampleTest, ChecksOptionsAndMesh) {
  const TriangleMesh mesh = cube({0, 0, 0}, 1.0);
  const auto sample = [&](SampleOptions options) {
    return [&mesh, options] { static_cast<void>(sample_surface(mesh, options)); };
  };
  EXPECT_EQ(error_of(sample({.count = 0}), ErrorCode::kUsage),
            "SampleOptions.count is 0; expected 1 to 2147483648");
  EXPECT_EQ(error_of(sample({.noise = 1.5}), ErrorCode::kUsage),
            "SampleOptions.noise is 1.5; expected 0 to 1");
  error_of(sample({.noise = std::nan("")}), ErrorCode::kUsage);
  EXPECT_TRUE(contains(error_of([] { static_cast<void>(sample_surface({}, {})); }), "no area"));
  const TriangleMesh broken{{{0, 0, 0}}, {{0, 0, 4}}};
  EXPECT_TRUE(contains(error_of([&] { static_cast<void>(sample_surface(broken, {})); }),
                       "triangle 0 has the vertex index 4"));
}

}  // namespace
}  // namespace morsel::io
