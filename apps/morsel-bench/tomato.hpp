// GUDHI's ToMATo, clusters of points by the persistence of the peaks of their density, to compare
// with. Debian's C++ package lacks it, so its Python package does the work.
//
// Source: F. Chazal, L. Guibas, S. Oudot, P. Skraba, "Persistence-Based Clustering in Riemannian
// Manifolds", JACM 2013, as in GUDHI.
#pragma once

#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel::bench {

struct TomatoOptions {
  int neighbors = 10;           ///< of the graph
  int density_neighbors = 100;  ///< of the density: logarithm of the mean distance to them
  double prominence = 0.1;      ///< of a peak that is a cluster of its own
};

struct TomatoResult {
  std::vector<int> labels;    ///< one a point
  double core_seconds = 0.0;  ///< without starting Python
};

/// Whether Debian's Python has GUDHI and SciPy.
[[nodiscard]] bool has_tomato();

/// Throws Error(kResource) when Python fails.
[[nodiscard]] TomatoResult tomato(std::span<const Vec3> points, const TomatoOptions& options);

}  // namespace morsel::bench
