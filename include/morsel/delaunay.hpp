// morsel: the Delaunay triangulation of the points as flat arrays, the one data structure that all
// later stages read.
//
// Source: T. K. Dey, J. Giesen, S. Goswami, "Shape Segmentation and Matching from Noisy Point
// Clouds", SPBG 2004, section 2.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <morsel/progress.hpp>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel {

/// Stands for "no cell": what lies beyond the convex hull.
inline constexpr std::uint32_t kNoCell = 0xffffffffU;
/// Stands for "no vertex": points of the ground.
inline constexpr std::uint32_t kNoVertex = 0xffffffffU;

/// The finite part of a 3D Delaunay triangulation.
///
/// Vertices are the distinct points in a canonical spatial order, cells are sorted by their
/// smallest vertices: the same set of points gives the same arrays, whatever their order in the
/// input and whatever the number of threads. Co-spherical points are triangulated by CGAL's
/// symbolic perturbation, which depends on the coordinates alone.
struct DelaunayComplex {
  std::vector<Vec3> vertices;                           ///< (v, 3), in the unit of the input
  std::vector<std::uint32_t> vertex_of_point;           ///< (n), the vertex of each input point,
                                                        ///< kNoVertex where it was set apart
  std::vector<std::array<std::uint32_t, 4>> cells;      ///< (c, 4) vertices, positively oriented
  std::vector<std::array<std::uint32_t, 4>> neighbors;  ///< (c, 4) the cell opposite each vertex
  std::vector<Vec3> centers;                            ///< (c, 3) centres of the Delaunay balls
  std::vector<double> radii;                            ///< (c) radii of the Delaunay balls
  int dimension = -1;  ///< of the points' affine hull, -1 (no point) … 3; below 3 there is no cell

  /// Number of finite cells.
  [[nodiscard]] std::size_t cell_count() const { return cells.size(); }
};

/// How the work is done; what comes of it is the same.
struct TriangulateOptions {
  int threads = 0;  ///< 0: all cores. The result does not depend on it.
};

/// Triangulates the points (n, 3); finite coordinates, n < 2^31. Repeated points become one vertex.
/// Throws Error(kInput) naming a point that is not finite, Error(kResource), Error(kCancelled).
/// Cost: O(n log n) expected on points near surfaces; about 900 bytes a point at its peak.
[[nodiscard]] DelaunayComplex triangulate(std::span<const Vec3> points,
                                          const TriangulateOptions& options = {},
                                          const Progress* progress = nullptr);

/// Signed volume of a cell; positive for cells of a DelaunayComplex up to rounding.
[[nodiscard]] double cell_volume(const DelaunayComplex& complex, std::size_t cell);

/// Mean of a cell's four vertices.
[[nodiscard]] Vec3 cell_centroid(const DelaunayComplex& complex, std::size_t cell);

/// Which cells meet at each vertex: those of vertex v are cells[offsets[v] … offsets[v + 1]).
struct VertexCells {
  std::vector<std::uint32_t> offsets;  ///< (v + 1)
  std::vector<std::uint32_t> cells;    ///< (4c), ascending for each vertex

  /// Cells that meet at a vertex, ascending.
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t vertex) const {
    return std::span(cells).subspan(offsets[vertex], offsets[vertex + 1] - offsets[vertex]);
  }
};

/// Cost: O(v + c).
[[nodiscard]] VertexCells find_vertex_cells(const DelaunayComplex& complex);

/// λ of the paper: each vertex's mean distance to its three nearest vertices (to all others where
/// there are fewer), exact. Cost: O(v log v).
/// Source: Dey, Giesen, Goswami 2004, section 2.
[[nodiscard]] std::vector<double> mean_neighbor_distance(const DelaunayComplex& complex,
                                                         int threads = 0);

}  // namespace morsel
