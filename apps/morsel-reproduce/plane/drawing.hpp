// The steps in the plane as SVG.
#pragma once

#include <string>
#include <vector>

#include "plane/plane.hpp"

namespace morsel::plane {

/// Six pictures of one size: triangulation; all balls, the small ones set apart; union of the inner
/// big balls; inner triangles, those that hold maxima shaded; basins; merged parts.
[[nodiscard]] std::vector<std::string> draw_steps(const Shape& shape);

/// The surroundings of a saddle: the two basins, the edge between them, the ways to the maxima.
[[nodiscard]] std::string draw_saddle(const Shape& shape, const Saddle& saddle);

}  // namespace morsel::plane
