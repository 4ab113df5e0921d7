// PCL's ensemble of shape functions, a descriptor of point clouds to compare with.
//
// Source: W. Wohlkinger, M. Vincze, "Ensemble of Shape Functions for 3D Object Classification",
// ROBIO 2011, as in the Point Cloud Library.
#pragma once

#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel::bench {

/// Whether PCL was there at build time.
[[nodiscard]] bool has_esf();

/// 640 values; none without PCL. PCL draws its random points by the clock: they differ a little
/// from one call to the next.
[[nodiscard]] std::vector<float> esf(std::span<const Vec3> points);

}  // namespace morsel::bench
