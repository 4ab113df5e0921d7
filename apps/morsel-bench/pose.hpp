// morsel-bench: shapes in random poses.
#pragma once

#include <cstdint>
#include <morsel/vec3.hpp>
#include <vector>

namespace morsel::bench {

/// Turned, scaled by e^-2 to e^2 and moved by ten units at random; half of all are mirrored, if
/// `mirror` allows.
[[nodiscard]] std::vector<Vec3> posed(std::vector<Vec3> points, std::uint64_t seed,
                                      bool mirror = true);

}  // namespace morsel::bench
