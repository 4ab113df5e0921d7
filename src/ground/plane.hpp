// The plane that bears most of a cloud, and whether it is the ground beyond doubt.
#pragma once

#include <array>
#include <cstddef>
#include <morsel/ground.hpp>
#include <morsel/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace morsel {

/// The plane with most points on it and fewest on its emptier side, as thick as its points' noise.
/// None where no plane has more of the former. `points` is a sample of the cloud, of extent
/// `diagonal`. Cost: O(n).
[[nodiscard]] std::optional<GroundPlane> find_plane(std::span<const Vec3> points, double diagonal);

/// Whether it bears a fair share of all points in a single sheet, with nearly none beneath it, and
/// reaches beyond all that stands on it on nearly all sides. Cost: O(n).
[[nodiscard]] bool is_unmistakable(std::span<const Vec3> points, const GroundPlane& plane,
                                   double diagonal);

/// Two unit vectors in the plane.
[[nodiscard]] std::array<Vec3, 2> plane_axes(const GroundPlane& plane);

}  // namespace morsel
