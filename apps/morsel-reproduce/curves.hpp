// morsel-reproduce: what changes with noise, outliers, the paper's two numbers, and with how much
// of a signature is kept.
#pragma once

#include "describe.hpp"
#include "study.hpp"

namespace morsel::reproduce {

/// Rand error and retrieval at each level of noise and of outliers; noisy queries, clean stored
/// shapes.
[[nodiscard]] nlohmann::ordered_json disturbance_curves(const Study& study,
                                                        const Collection& generated);

/// Rand error over the ratio above which a ball is big, and over the merge ratio.
[[nodiscard]] nlohmann::ordered_json parameter_curves(const Study& study);

/// Retrieval by the paper's score when only the heaviest points are kept.
[[nodiscard]] nlohmann::ordered_json point_curve(const Study& study, const Collection& generated);

}  // namespace morsel::reproduce
