// Solids that need no data: unions of simple bodies with holes drilled into them, sampled on their
// surface with the true part of every sample. For the benchmarks, the reproduction and the tests.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace morsel::solids {

/// Three unit vectors at right angles.
using Frame = std::array<Vec3, 3>;
inline constexpr Frame kUpright{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

/// The convex hull of two balls: a capsule when they are equally large, a ball when they coincide.
struct Limb {
  Vec3 a;
  Vec3 b;
  double radius_a = 1.0;
  double radius_b = 1.0;
};

/// A cone cut off between two disks, which it has for ends; a cylinder when they are equally large.
struct Frustum {
  Vec3 a;
  Vec3 b;
  double radius_a = 1.0;
  double radius_b = 1.0;
};

struct Ellipsoid {
  Vec3 center;
  Vec3 half;  ///< half axes along the frame
  Frame frame = kUpright;
};

struct Block {
  Vec3 center;
  Vec3 half;  ///< half sides along the frame
  Frame frame = kUpright;
};

using Body = std::variant<Limb, Frustum, Ellipsoid, Block>;

/// Where a line runs inside a convex body: from `enter` to `leave` along a unit direction.
struct Stretch {
  double enter = 0.0;
  double leave = 0.0;
};
[[nodiscard]] std::optional<Stretch> stretch_inside(const Body& body, const Vec3& origin,
                                                    const Vec3& direction);

/// A body of a solid, or one that is taken out of all others.
struct Piece {
  Body body;
  int part = 0;       ///< what a person would call it, from 0; several pieces may be one part
  bool hole = false;  ///< its walls belong to the part that it is drilled into
};

/// The union of its pieces without its holes.
using Solid = std::vector<Piece>;

/// A beast of ten capsules: body, neck, head, two ears, tail, four legs.
[[nodiscard]] Solid beast();

struct SurfaceOptions {
  std::size_t count = 50000;
  double noise = 0.0;  ///< standard deviation as a fraction of the bounding-box diagonal
  std::uint64_t seed = 1;
};

struct LabelledPoints {
  std::vector<Vec3> points;
  std::vector<int> parts;  ///< of the solid, one a point
};

/// Uniform on the surface of the solid, which has one: where random lines meet it. Holes are seen
/// from the inside of the solid alone. The same for the same seed on every machine.
/// Source: the Cauchy-Crofton formula, L. A. Santaló, "Integral Geometry and Geometric
/// Probability", 1976. Cost: O(pieces) a line; a line gives S / (2π R²) points, S the surface and R
/// the radius of a ball around the solid.
[[nodiscard]] LabelledPoints sample(const Solid& solid, const SurfaceOptions& options);

/// Moves points along smooth waves of space, long against the beast's limbs. Samples of exact
/// spheres and cylinders are cospherical by the thousand, as no scan's are: their Delaunay balls
/// nearly coincide, and exact arithmetic and slivers then take most of the time.
void bend(std::span<Vec3> points);

}  // namespace morsel::solids
