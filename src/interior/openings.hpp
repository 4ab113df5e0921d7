// Closes the inside of open surfaces across their openings.
#pragma once

#include <morsel/interior.hpp>
#include <vector>

namespace morsel {

struct Closing {
  bool leaked = false;      ///< the walk had entered, and some of what it reached is inner now
  double bare_share = 0.0;  ///< of the surface: what still has the outside on both faces
};

/// Finds pockets among the outer seeds: balls that the walk from outside reached through an opening
/// of a third at most of the surface around them, where that surface has the outside on both of
/// its faces. They become inner, and with them all that is reached from them by wider passages than
/// from outside. A closed surface has none, since its own inside is behind the walls of its
/// hollows. `side` holds the seeds of both kinds, all others are open; the walk went on where balls
/// meet at an angle of a cosine above `min_cosine`.
///
/// Differs: the paper labels whatever its walk reaches as outer. Cost: O(v + c), and O(c log c)
/// where a notable part of the surface has the outside on both faces.
[[nodiscard]] Closing close_openings(const DelaunayComplex& complex,
                                     const VertexCells& vertex_cells,
                                     const std::vector<double>& lambda, double min_cosine,
                                     std::vector<CellSide>& side, int threads);

struct Openings {
  std::vector<Opening> list;  ///< the widest first
  double share = 0.0;         ///< of the inside's surface
};

/// Where facets between inner cells and others are too wide to be surface. Unless the outside
/// `leaked` in before, an opening must take 3% of the inside's surface. Cost: O(v + c).
[[nodiscard]] Openings find_openings(const DelaunayComplex& complex,
                                     const std::vector<double>& lambda,
                                     const std::vector<CellSide>& side, bool leaked, int threads);

}  // namespace morsel
