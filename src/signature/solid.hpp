// What the tables read of the inside, cell by cell and vertex by vertex.
#pragma once

#include <morsel/delaunay.hpp>
#include <morsel/segment.hpp>
#include <vector>

namespace morsel {

/// Centroid and root mean square radius.
struct Frame {
  Vec3 centroid;
  double size = 0.0;
};

/// Each point counts the same.
[[nodiscard]] Frame frame_of_points(const std::vector<Vec3>& points);

/// The inner cells as bodies of mass.
struct Solid {
  struct Cell {
    std::uint32_t cell = 0;
    double share = 0.0;  ///< of the volume
    Vec3 centroid;
    double thickness = 0.0;  ///< radius of the largest inner ball that touches a corner of it
  };
  std::vector<Cell> cells;
  std::vector<double> vertex_thickness;  ///< (v) largest thickness of the cells around; 0 outside
  std::vector<double> vertex_share;      ///< (v) of the volume, a quarter of the cells around
  double volume = 0.0;
  double solidity = 0.0;  ///< share of the vertices that are corners of an inner cell
  Frame frame;            ///< of the volume
};

/// Thickness comes from balls no larger than their basin's maximum: a cell that leaks out of the
/// shape does not count with its own huge ball. Cost: O(c).
[[nodiscard]] Solid find_solid(const DelaunayComplex& complex, const Basins& basins);

}  // namespace morsel
