// Denoising of points that are sorted already.
#pragma once

#include <morsel/denoise.hpp>

#include "base/spatial_order.hpp"

namespace morsel {

/// As denoise() of the points that `order` was made of. `options` are valid; who may cancel is for
/// the caller to say.
[[nodiscard]] Denoised denoise(const SpatialOrder& order, const DenoiseOptions& options);

}  // namespace morsel
