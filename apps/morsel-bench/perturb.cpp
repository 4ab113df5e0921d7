#include "perturb.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace morsel::bench {

Signature perturbed(const Signature& base, const Signature& mate, double noise, Random& random) {
  Signature signature = base;
  const double toward = 0.5 * random.uniform();
  for (std::size_t i = 0; i < signature.tables.size(); ++i) {
    const double from = base.tables[i];
    const double value = from + toward * (mate.tables[i] - from);
    const double changed = value + random.normal() * (noise * value + 1.0);
    signature.tables[i] = static_cast<std::uint8_t>(std::lround(std::clamp(changed, 0.0, 255.0)));
  }
  return signature;
}

}  // namespace morsel::bench
