// morsel-bench: the same shape in another posture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <morsel/io.hpp>

namespace morsel::bench {

struct Bent {
  TriangleMesh mesh;      ///< the same triangles, vertices moved
  std::size_t limbs = 0;  ///< that were bent; 0: the mesh is as it was
};

/// Turns each limb by 30 to 60 degrees about its joint, the surface following smoothly. A limb is
/// what lies within some way along the surface of an extremity, if it is thin there and no more
/// than a third of the shape; the joint is the middle of the ring around it. The mesh's triangles
/// share their vertices. Cost: O(v log v) a limb.
[[nodiscard]] Bent bend_limbs(const TriangleMesh& mesh, std::uint64_t seed);

}  // namespace morsel::bench
