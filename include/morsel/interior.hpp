// morsel: which cells of the triangulation fill the shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <morsel/delaunay.hpp>
#include <morsel/vec3.hpp>
#include <string>
#include <vector>

namespace morsel {

/// The published rules or the default ones; a preset of the same stages.
enum class Method : std::uint8_t { kDefault, kPaper };

/// Where a cell lies.
enum class CellSide : std::uint8_t {
  kOpen,   ///< not decided: its ball is too small to tell (paper: "not big")
  kOuter,  ///< outside the shape
  kInner,  ///< inside the shape
};

/// How inside and outside are told apart.
struct InteriorOptions {
  Method method = Method::kDefault;
  /// Paper: ρ, a ball is big when its radius exceeds ρ·λ of any of its corners; > 0.
  double big_ball_ratio = 0.5;
  /// Paper: balls meet deeply when the angle between the directions to their centres is below this,
  /// in degrees, 0 … 180. Not published; docs/paper-parameters.md says what other values do.
  double deep_angle = 60.0;

  /// Throws Error(kUsage) that names field, value and range.
  void check() const;
};

/// A gap in the surface that the inside was closed across.
struct Opening {
  Vec3 center;
  double radius = 0.0;  ///< of a disk as large, in units
};

/// One side per cell, and what the labelling saw.
struct Interior {
  std::vector<CellSide> side;  ///< (c)
  std::size_t inner_cells = 0;
  std::size_t outer_cells = 0;
  /// Of the inner cells and, in a Segmentation, of what bulges over them, in cubed units.
  double volume = 0.0;
  // Of the default method alone:
  /// (c) Volume between each inner cell and the surface that all points show, in cubed units; set
  /// in a Segmentation, empty where all points are vertices or smoothing moved them.
  std::vector<double> bulges;
  std::vector<Opening> openings;  ///< of the inside's surface, the widest first
  double open_share = 0.0;        ///< of the inside's surface: what the openings take, 0 … 1
  double bare_share = 0.0;        ///< of the points' surface: what has no inside behind it, 0 … 1
};

/// Labels each cell inner, outer or open. `lambda` is mean_neighbor_distance of the vertices.
///
/// Method::kPaper walks from the unbounded balls through adjacent big balls that meet deeply; what
/// it reaches is outer, the other big balls are inner.
/// Source: Dey, Giesen, Goswami 2004, section 2.
///
/// Method::kDefault walks so with strict thresholds, which leaves two kinds of seeds, and floods
/// from both over the remaining cells, strongest connection first; what lies opposite a seed, as
/// seen from a vertex, is connected with the other kind. Between the two, openings of the surface
/// are closed that are small against the surface behind them.
/// Source: N. Amenta, S. Choi, R. Kolluri, "The Power Crust", 2001, for what lies opposite.
/// Differs: bigness is measured against the largest λ of a cell's corners, and no threshold decides
/// the cells between the seeds. Cost: O(c log c).
[[nodiscard]] Interior find_interior(const DelaunayComplex& complex,
                                     const VertexCells& vertex_cells,
                                     const std::vector<double>& lambda,
                                     const InteriorOptions& options = {}, int threads = 0);

}  // namespace morsel
