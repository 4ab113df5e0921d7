#include "signature/harmonics.hpp"

#include <cmath>
#include <vector>

namespace morsel {

// Associated Legendre functions divided by sin^m, times Re and Im of (x + iy)^m: no trigonometry
// and nothing special at the poles.
void evaluate_harmonics(const Vec3& direction, std::size_t degree, std::span<double> values) {
  const double z = direction.z;
  double cosine = 1.0;  // Re (x + iy)^m
  double sine = 0.0;    // Im (x + iy)^m
  double diagonal = 1.0;
  for (std::size_t m = 0; m <= degree; ++m) {
    const auto dm = static_cast<double>(m);
    if (m > 0) {
      diagonal *= std::sqrt((2.0 * dm + 1.0) / (2.0 * dm));
      const double next = cosine * direction.x - sine * direction.y;
      sine = cosine * direction.y + sine * direction.x;
      cosine = next;
    }
    const double scale = m == 0 ? 1.0 : std::sqrt(2.0);
    double before = 0.0;
    double legendre = diagonal;
    for (std::size_t l = m; l <= degree; ++l) {
      const auto dl = static_cast<double>(l);
      if (l > m) {
        const double a = std::sqrt((4.0 * dl * dl - 1.0) / (dl * dl - dm * dm));
        const double b = std::sqrt(((dl - 1.0) * (dl - 1.0) - dm * dm) /
                                   (4.0 * (dl - 1.0) * (dl - 1.0) - 1.0));
        const double next = a * (z * legendre - (l > m + 1 ? b * before : 0.0));
        before = legendre;
        legendre = next;
      }
      values[l * l + l + m] = scale * legendre * cosine;
      if (m > 0) values[l * l + l - m] = scale * legendre * sine;
    }
  }
}

double harmonic_energy(std::span<const double> coefficients, std::size_t l) {
  double sum = 0.0;
  for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i) sum += coefficients[i] * coefficients[i];
  return std::sqrt(sum);
}

}  // namespace morsel
