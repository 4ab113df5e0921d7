// Where objects stand on the ground.
#pragma once

#include <cstddef>
#include <morsel/ground.hpp>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel {

/// What belongs to the ground, and what closes the objects from below.
struct Contact {
  std::vector<char> apart;  ///< (n) 1: of the ground, or a crumb on it
  std::vector<Vec3> base;   ///< points that the plane lacks where something stands on it
};

/// A grid in the plane, about as wide as the spacing: what lies just above the plane draws the
/// outlines of the objects' feet, and what they enclose are the feet. Points of the plane in them
/// stay with the objects. Cost: O(n log n).
[[nodiscard]] Contact find_contact(std::span<const Vec3> points, const GroundPlane& plane,
                                   int threads);

}  // namespace morsel
