// morsel-bench: many signatures out of a few real ones.
#pragma once

#include <morsel/signature.hpp>

#include "base/random.hpp"

namespace morsel::bench {

/// Change of each value as a share of it, beside one byte; another sampling changes some 0.02.
inline constexpr double kPerturbation = 0.02;

/// Somewhere between two real shapes, nearer to the first, each value then changed on its own.
[[nodiscard]] Signature perturbed(const Signature& base, const Signature& mate, double noise,
                                  Random& random);

}  // namespace morsel::bench
