// Which pieces see each other through the inside: a measure of how convex their union is.
#pragma once

#include <morsel/interior.hpp>
#include <vector>

#include "segment/pieces.hpp"

namespace morsel {

/// Symmetric (p, p) tables, row by row.
struct SightTable {
  std::vector<float> seen;  ///< 1 where the segment between two pieces' seeds stays inside, else 0
  std::vector<float> weight;  ///< how much a pair counts: falls off with its distance
};

/// Walks the triangulation along the segments between the seeds of pieces that are not too far
/// apart. A segment may leave the inside for up to half the points' `spacing`. Source: O. van Kaick
/// et al., "Shape Segmentation by Approximate Convexity Analysis", ACM TOG 2014 (lines of sight).
/// Differs: inside the Delaunay cells instead of on a mesh, between points of the inside, nearby
/// pairs only. Cost: O(p² · cells along a segment).
[[nodiscard]] SightTable find_sight(const DelaunayComplex& complex, const Interior& interior,
                                    const Pieces& pieces, double spacing, int threads);

}  // namespace morsel
