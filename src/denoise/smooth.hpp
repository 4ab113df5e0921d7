// Takes noise off a cloud without pulling its curves in or its thin walls together.
#pragma once

#include <morsel/vec3.hpp>
#include <vector>

#include "denoise/cover.hpp"

namespace morsel {

/// The points that a cover keeps, each moved along its normal, `rounds` times, onto the surface
/// that its neighbours agree on: in the first round those among all points, then among the points
/// kept. What a point stands for has its normal. A neighbour counts less the farther it is, the
/// more its normal differs and the farther it lies off the point's plane; so the two sides of a
/// wall, and of an edge, stay apart. Its say is the mean of its height over the point's plane and
/// the point's depth under its own: on an evenly curved surface the two cancel, so that nothing
/// shrinks. Source: S. Fleishman, I. Drori, D. Cohen-Or, "Bilateral Mesh Denoising", SIGGRAPH 2003;
/// normals filtered first as in Y. Zheng et al., "Bilateral Normal Filtering for Mesh Denoising",
/// TVCG 2011. Differs: no mesh and no orientation; the symmetric height is ours. Throws
/// Error(kCancelled). Cost: O(n log n).
[[nodiscard]] std::vector<Vec3> smooth(const Cover& cover, int rounds, int threads);

}  // namespace morsel
