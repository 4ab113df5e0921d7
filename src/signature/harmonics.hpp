// Real spherical harmonics, for statistics over directions that no rotation changes.
#pragma once

#include <cstddef>
#include <morsel/vec3.hpp>
#include <span>

namespace morsel {

/// Harmonics of all degrees up to `degree`.
[[nodiscard]] constexpr std::size_t harmonic_count(std::size_t degree) {
  return (degree + 1) * (degree + 1);
}

/// Fills Y_lm of a unit vector at l² + l + m, orthonormal over the sphere up to the factor √(4π):
/// Σ_m Y_lm² = 2l + 1 in every direction. `values` has harmonic_count(degree) places.
void evaluate_harmonics(const Vec3& direction, std::size_t degree, std::span<double> values);

/// √Σ_m a_lm² of degree l: unchanged when the function behind the coefficients is turned or
/// mirrored.
[[nodiscard]] double harmonic_energy(std::span<const double> coefficients, std::size_t l);

}  // namespace morsel
