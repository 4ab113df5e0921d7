// The ground among points that are sorted already.
#pragma once

#include <morsel/ground.hpp>

#include "base/spatial_order.hpp"

namespace morsel {

/// As find_ground() of the points that `order` was made of.
[[nodiscard]] Ground find_ground(const SpatialOrder& order, const GroundOptions& options);

}  // namespace morsel
