// What lies between the triangles around the inside and the surface that all points show.
#pragma once

#include <cstdint>
#include <morsel/interior.hpp>
#include <span>
#include <vector>

namespace morsel {

/// Points of the surface, each with the vertex that is near it.
struct SurfaceSamples {
  std::span<const Vec3> points;
  std::span<const std::uint32_t> vertex;
};

/// (c) The volume between each inner cell's facets that bound the inside and the surface above
/// them, negative where it lies beneath, in cubed units: triangles cut off what bulges and fill
/// what is hollow. It is the area of a triangle times how high the samples around its corners lie,
/// on average. Cost: O(c + samples).
[[nodiscard]] std::vector<double> find_bulges(const DelaunayComplex& complex,
                                              const std::vector<CellSide>& side,
                                              const SurfaceSamples& samples);

}  // namespace morsel
