// morsel-bench: a closed shape that needs no data: overlapping capsules, sampled on the surface of
// their union.
#pragma once

#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel::bench {

/// All points within `radius` of the segment from `a` to `b`; a ball when they are equal.
struct Capsule {
  Vec3 a;
  Vec3 b;
  double radius = 1.0;
};

/// Negative inside.
[[nodiscard]] double signed_distance(const Capsule& capsule, const Vec3& point);

/// A beast of ten capsules: body, neck, head, two ears, tail, four legs.
[[nodiscard]] std::vector<Capsule> beast();

struct ShapeOptions {
  std::size_t count = 50000;
  double noise = 0.0;  ///< standard deviation as a fraction of the bounding-box diagonal
  std::uint64_t seed = 1;
};

/// Uniform on the surface of the union: samples of a capsule inside another one are rejected.
[[nodiscard]] std::vector<Vec3> sample_union(std::span<const Capsule> capsules,
                                             const ShapeOptions& options);

/// Moves points along smooth waves of space, long against the beast's limbs. Samples of exact
/// spheres and cylinders are cospherical by the thousand, as no scan's are: their Delaunay balls
/// nearly coincide, and exact arithmetic and slivers then take most of the time.
void bend(std::span<Vec3> points);

}  // namespace morsel::bench
