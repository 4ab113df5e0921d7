#include "signature/harmonics.hpp"

#include <gtest/gtest.h>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

constexpr std::size_t kDegree = 6;

// Addition theorem: Σ_m Y_lm(u) Y_lm(v) = (2l + 1) P_l(u · v).
TEST(HarmonicsTest, AdditionTheorem) {
  const Harmonics<kDegree> harmonics;
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3 u = i == 0 ? Vec3{0, 0, 1} : shapes::random_direction(random);
    const Vec3 v = i == 1 ? Vec3{0, 0, -1} : shapes::random_direction(random);
    Harmonics<kDegree>::Values a{};
    Harmonics<kDegree>::Values b{};
    harmonics.evaluate(u, a);
    harmonics.evaluate(v, b);
    for (std::size_t l = 0; l <= kDegree; ++l) {
      const double expected =
          (2.0 * static_cast<double>(l) + 1.0) * std::legendre(static_cast<unsigned>(l), dot(u, v));
      EXPECT_NEAR(harmonic_product(a, b, l), expected, 1e-12);
    }
  }
}

}  // namespace
}  // namespace morsel
