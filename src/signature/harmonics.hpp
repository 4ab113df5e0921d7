// Real spherical harmonics, for statistics over directions that no rotation changes.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <morsel/vec3.hpp>
#include <numeric>

namespace morsel {

/// All harmonics up to degree kDegree, Y_lm at l² + l + m; normalised so that Σ_m Y_lm² = 2l + 1 in
/// every direction.
template <std::size_t kDegree>
class Harmonics {
 public:
  static constexpr std::size_t kCount = (kDegree + 1) * (kDegree + 1);
  using Values = std::array<double, kCount>;

  Harmonics() {
    for (std::size_t m = 0; m <= kDegree; ++m) {
      const auto dm = static_cast<double>(m);
      diagonal_[m] = m == 0 ? 1.0 : std::sqrt((2.0 * dm + 1.0) / (2.0 * dm));
      for (std::size_t l = m + 1; l <= kDegree; ++l) {
        const auto dl = static_cast<double>(l);
        const double before = dl - 1.0;
        rise_[m][l] = std::sqrt((4.0 * dl * dl - 1.0) / (dl * dl - dm * dm));
        fall_[m][l] = l == m + 1
                          ? 0.0
                          : std::sqrt((before * before - dm * dm) / (4.0 * before * before - 1.0));
      }
    }
  }

  /// Of a unit vector. Associated Legendre functions divided by sin^m, times Re and Im of
  /// (x + iy)^m: no trigonometry and nothing special at the poles.
  void evaluate(const Vec3& direction, Values& values) const {
    double cosine = 1.0;  // √2 Re (x + iy)^m, without the root for m = 0
    double sine = 0.0;
    double diagonal = 1.0;
    for (std::size_t m = 0; m <= kDegree; ++m) {
      if (m > 0) {
        diagonal *= diagonal_[m];
        const double scale = m == 1 ? std::sqrt(2.0) : 1.0;
        const double next = scale * (cosine * direction.x - sine * direction.y);
        sine = scale * (cosine * direction.y + sine * direction.x);
        cosine = next;
      }
      double before = 0.0;
      double legendre = diagonal;
      for (std::size_t l = m; l <= kDegree; ++l) {
        if (l > m) {
          const double next = rise_[m][l] * (direction.z * legendre - fall_[m][l] * before);
          before = legendre;
          legendre = next;
        }
        values[l * l + l + m] = legendre * cosine;
        if (m > 0) values[l * l + l - m] = legendre * sine;
      }
    }
  }

 private:
  std::array<double, kDegree + 1> diagonal_{};
  std::array<std::array<double, kDegree + 1>, kDegree + 1> rise_{};
  std::array<std::array<double, kDegree + 1>, kDegree + 1> fall_{};
};

/// Σ_m a_lm b_lm of degree l: unchanged when the functions behind the coefficients are turned or
/// mirrored together.
template <typename Values>
[[nodiscard]] double harmonic_product(const Values& a, const Values& b, std::size_t l) {
  return std::inner_product(a.begin() + l * l, a.begin() + (l + 1) * (l + 1), b.begin() + l * l,
                            0.0);
}

}  // namespace morsel
