// From basins of cells to basins of points.
#pragma once

#include <cstdint>
#include <morsel/segment.hpp>
#include <vector>

namespace morsel {

/// The basin of every vertex: among the basins of the inner cells around it and the basins that
/// touch those, the one with the smallest |p - c| / R to its maximum's ball; vertices without an
/// inner cell take their nearest labelled Delaunay neighbour's. kNoBasin only without any basin.
/// `necks` are all pairs of touching basins.
[[nodiscard]] std::vector<std::uint32_t> label_vertices(const DelaunayComplex& complex,
                                                        const VertexCells& vertex_cells,
                                                        const Basins& basins,
                                                        const std::vector<Neck>& necks,
                                                        int threads);

}  // namespace morsel
