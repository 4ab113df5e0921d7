// Which pieces see each other through the inside: a measure of how convex their union is.
#pragma once

#include <cstdint>
#include <deque>
#include <morsel/interior.hpp>
#include <vector>

#include "base/threads.hpp"

namespace morsel {

/// Symmetric (p, p) tables, row by row.
struct SightTable {
  std::vector<float> seen;  ///< 1 where the segment between two pieces' seeds stays inside, else 0
  /// How much a pair counts: falls off with its distance; 0 for those that are not looked at.
  std::vector<float> weight;
};

/// Walks the triangulation along the segments between the seeds of pieces that are not too far
/// apart, from every piece as soon as it is added, on other threads than the caller's if there are
/// more. A segment may leave the inside for up to half the points' `spacing`. Source: O. van Kaick
/// et al., "Shape Segmentation by Approximate Convexity Analysis", ACM TOG 2014 (lines of sight).
/// Differs: inside the Delaunay cells instead of on a mesh, between points of the inside, nearby
/// pairs only. Cost: O(p² · cells along a segment).
class SightSearch {
 public:
  /// Holds references to both until it is destroyed.
  SightSearch(const DelaunayComplex& complex, const Interior& interior, double spacing,
              int threads);

  /// The next piece: the inner cell that it grows from, and the extent of its object.
  void add(std::uint32_t seed, double extent);

  /// Waits for all walks.
  [[nodiscard]] SightTable table();

 private:
  struct Place {
    std::uint32_t cell;
    Vec3 centroid;
  };
  // What a piece sees of those before it and of itself, as in the tables.
  struct Row {
    std::vector<float> seen;
    std::vector<float> weight;
  };

  void fill(const std::vector<Place>& places, double extent, Row& row) const;

  const DelaunayComplex& complex_;
  const Interior& interior_;
  double spacing_;
  std::vector<Place> places_;
  std::deque<Row> rows_;
  BackgroundTasks walks_;  // last: ends before what it works on
};

}  // namespace morsel
