// How many points of a noisy cloud show its surface.
#pragma once

#include <cstddef>
#include <morsel/vec3.hpp>
#include <span>

namespace morsel {

/// All of the points, or a half, a quarter, … of them where noise is several times wider than their
/// spacing: neighbourhoods look like balls then, not like a surface, until the cloud is so much
/// thinner. They are `ordered` along the curve of base/spatial_order.hpp. Cost: that of some
/// thousand planes.
[[nodiscard]] std::size_t useful_points(std::span<const Vec3> ordered, int threads);

}  // namespace morsel
