#include "signature/solid.hpp"

#include <algorithm>
#include <cmath>

namespace morsel {
namespace {

// The largest inner ball at each vertex.
std::vector<double> largest_balls(const DelaunayComplex& complex, const Basins& basins) {
  std::vector<double> ball(complex.vertices.size(), 0.0);
  for (std::size_t c = 0; c < basins.basin_of_cell.size(); ++c) {
    const std::uint32_t b = basins.basin_of_cell[c];
    if (b == kNoBasin) continue;
    const double radius = std::min(complex.radii[c], complex.radii[basins.maximum[b]]);
    for (const std::uint32_t v : complex.cells[c]) ball[v] = std::max(ball[v], radius);
  }
  return ball;
}

Frame frame_of_cells(const std::vector<Solid::Cell>& cells) {
  Frame frame;
  for (const Solid::Cell& cell : cells)
    frame.centroid = frame.centroid + cell.share * cell.centroid;
  double spread = 0.0;
  for (const Solid::Cell& cell : cells) {
    spread += cell.share * squared_distance(cell.centroid, frame.centroid);
  }
  frame.size = std::sqrt(spread);
  return frame;
}

}  // namespace

Frame frame_of_points(const std::vector<Vec3>& points) {
  Frame frame;
  const double share = 1.0 / static_cast<double>(points.size());
  for (const Vec3& p : points) frame.centroid = frame.centroid + share * p;
  double spread = 0.0;
  for (const Vec3& p : points) spread += share * squared_distance(p, frame.centroid);
  frame.size = std::sqrt(spread);
  return frame;
}

Solid find_solid(const DelaunayComplex& complex, const Basins& basins) {
  Solid solid;
  const std::vector<double> ball = largest_balls(complex, basins);
  for (std::size_t c = 0; c < basins.basin_of_cell.size(); ++c) {
    if (basins.basin_of_cell[c] == kNoBasin) continue;
    Solid::Cell cell{.cell = static_cast<std::uint32_t>(c),
                     .share = std::abs(cell_volume(complex, c)),
                     .centroid = cell_centroid(complex, c)};
    for (const std::uint32_t v : complex.cells[c]) {
      cell.thickness = std::max(cell.thickness, ball[v]);
    }
    solid.volume += cell.share;
    solid.cells.push_back(cell);
  }
  solid.vertex_thickness.assign(complex.vertices.size(), 0.0);
  solid.vertex_share.assign(complex.vertices.size(), 0.0);
  if (!(solid.volume > 0.0)) return solid;
  for (Solid::Cell& cell : solid.cells) {
    cell.share /= solid.volume;
    for (const std::uint32_t v : complex.cells[cell.cell]) {
      solid.vertex_thickness[v] = std::max(solid.vertex_thickness[v], cell.thickness);
      solid.vertex_share[v] += 0.25 * cell.share;
    }
  }
  const auto touched = std::ranges::count_if(ball, [](double radius) { return radius > 0.0; });
  solid.solidity = static_cast<double>(touched) / static_cast<double>(ball.size());
  solid.frame = frame_of_cells(solid.cells);
  return solid;
}

}  // namespace morsel
