// PCL's segmentations of point clouds into convex patches, to compare with.
//
// Source: J. Papon et al., "Voxel Cloud Connectivity Segmentation", CVPR 2013; S. C. Stein et al.,
// "Object Partitioning Using Local Convexity" (LCCP), CVPR 2014; M. Schoeler, J. Papon,
// F. Woergoetter, "Constrained Planar Cuts" (CPC), CVPR 2015; as in the Point Cloud Library.
#pragma once

#include <cstdint>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel::bench {

struct SupervoxelOptions {
  unsigned normal_neighbors = 20;   ///< of the plane fits
  double voxel = 0.015;             ///< share of the bounding-box diagonal
  double supervoxel = 0.05;         ///< distance of their seeds, likewise
  double concavity = 10.0;          ///< degrees that still count as convex
  std::uint32_t common_convex = 0;  ///< common neighbours to which both of a convex pair are convex
  bool sanity = true;               ///< pairs that touch at a point do not count as convex
  std::uint32_t smallest = 5;       ///< smaller groups of supervoxels join their largest neighbor
  std::uint32_t cuts = 20;          ///< CPC: at most
  double cut_score = 0.16;          ///< CPC: a plane's least score
  std::uint32_t smallest_to_cut = 0;  ///< CPC: supervoxels of a group that may be cut
};

/// Whether PCL was there at build time.
[[nodiscard]] bool has_supervoxels();

/// A label a point; none without PCL. Normals are those of fitted planes, turned to one side along
/// a spanning tree, since convexity needs a side and PCL alone turns them to a camera; a point that
/// PCL leaves without a label takes that of the nearest point with one.
[[nodiscard]] std::vector<int> lccp_labels(std::span<const Vec3> points,
                                           const SupervoxelOptions& options);
[[nodiscard]] std::vector<int> cpc_labels(std::span<const Vec3> points,
                                          const SupervoxelOptions& options);

}  // namespace morsel::bench
