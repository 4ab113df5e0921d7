#include "bend.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace morsel::bench {
namespace {

// A closed tube along x with rounded ends, of the radius that `radius_at(x)` gives.
template <typename Radius>
TriangleMesh tube(double length, const Radius& radius_at) {
  constexpr std::uint32_t kRings = 120;
  constexpr std::uint32_t kSides = 24;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kRings; ++i) {
    const double x = length * i / (kRings - 1);
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const double turn = 2.0 * std::numbers::pi * k / kSides;
      mesh.vertices.push_back({x, radius_at(x) * std::cos(turn), radius_at(x) * std::sin(turn)});
    }
  }
  for (std::uint32_t i = 0; i + 1 < kRings; ++i) {
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const std::uint32_t a = i * kSides + k;
      const std::uint32_t b = i * kSides + (k + 1) % kSides;
      mesh.triangles.push_back({a, b, a + kSides});
      mesh.triangles.push_back({b, b + kSides, a + kSides});
    }
  }
  return mesh;
}

// A ball with an arm to either side.
TriangleMesh ball_with_arms() {
  return tube(10.0, [](double x) {
    const double off = std::abs(x - 5.0);
    const double end = std::min(x, 10.0 - x);
    const double arm = 0.3 * std::sqrt(std::min(1.0, end / 0.3));
    return std::max(arm, off < 2.0 ? std::sqrt(4.0 - off * off) : 0.0);
  });
}

double edge_stretch(const TriangleMesh& a, const TriangleMesh& b) {
  double worst = 1.0;
  for (const auto& t : a.triangles) {
    const double before = distance(a.vertices[t[0]], a.vertices[t[1]]);
    const double after = distance(b.vertices[t[0]], b.vertices[t[1]]);
    if (before > 0.0) worst = std::max({worst, after / before, before / after});
  }
  return worst;
}

TEST(BendLimbs, TurnsTheArmsAndLeavesTheBodyAlone) {
  const TriangleMesh mesh = ball_with_arms();
  const Bent bent = bend_limbs(mesh, 1);
  EXPECT_EQ(bent.limbs, 2U);
  EXPECT_EQ(bent.mesh.triangles, mesh.triangles);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double moved = distance(mesh.vertices[v], bent.mesh.vertices[v]);
    const double off = std::abs(mesh.vertices[v].x - 5.0);
    EXPECT_TRUE(off > 0.7 || moved == 0.0) << v;
    EXPECT_TRUE(off < 4.9 || moved > 0.3) << v;
  }
  EXPECT_LT(edge_stretch(mesh, bent.mesh), 2.0);
}

TEST(BendLimbs, TheSameSeedBendsTheSame) {
  const TriangleMesh mesh = ball_with_arms();
  EXPECT_EQ(bend_limbs(mesh, 5).mesh.vertices, bend_limbs(mesh, 5).mesh.vertices);
  EXPECT_NE(bend_limbs(mesh, 5).mesh.vertices, bend_limbs(mesh, 6).mesh.vertices);
}

TEST(BendLimbs, ABallHasNoLimbs) {
  const TriangleMesh ball =
      tube(4.0, [](double x) { return std::sqrt(std::max(0.0, 4.0 - (x - 2.0) * (x - 2.0))); });
  const Bent bent = bend_limbs(ball, 1);
  EXPECT_EQ(bent.limbs, 0U);
  EXPECT_EQ(bent.mesh.vertices, ball.vertices);
}

}  // namespace
}  // namespace morsel::bench
