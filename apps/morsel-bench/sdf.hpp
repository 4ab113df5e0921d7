// CGAL's segmentation of closed meshes by the shape diameter function, to compare with.
//
// Source: L. Shapira, A. Shamir, D. Cohen-Or, "Consistent Mesh Partitioning and Skeletonisation
// Using the Shape Diameter Function", The Visual Computer 2008, as in CGAL.
#pragma once

#include <cstddef>
#include <morsel/io.hpp>
#include <vector>

namespace morsel::bench {

struct SdfOptions {
  std::size_t clusters = 5;  ///< levels of thickness
  double smoothing = 0.26;   ///< CGAL's smoothing_lambda, 0 to 1
};

/// A label a triangle. Throws Error(kInput) for a mesh that is no manifold.
[[nodiscard]] std::vector<int> sdf_labels(const TriangleMesh& mesh, const SdfOptions& options);

}  // namespace morsel::bench
