#include "sdf.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/mesh_segmentation.h>

#include <array>
#include <cstdint>
#include <morsel/error.hpp>

namespace morsel::bench {
namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

// Faces in the order of the triangles.
Mesh surface_mesh(const TriangleMesh& mesh) {
  std::vector<Point> points;
  for (const Vec3& p : mesh.vertices) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::vector<std::size_t>> polygons;
  for (const auto& [a, b, c] : mesh.triangles) polygons.push_back({a, b, c});
  processing::orient_polygon_soup(points, polygons);  // doubles the vertices that are no manifold
  Mesh result;
  if (processing::is_polygon_soup_a_polygon_mesh(polygons)) {
    processing::polygon_soup_to_polygon_mesh(points, polygons, result);
  }
  if (result.number_of_faces() != mesh.triangles.size()) {
    throw Error(ErrorCode::kInput, "not a manifold; CGAL's segmentation needs one");
  }
  return result;
}

}  // namespace

std::vector<int> sdf_labels(const TriangleMesh& mesh, const SdfOptions& options) {
  Mesh surface = surface_mesh(mesh);
  const auto values = surface.add_property_map<Mesh::Face_index, double>("f:sdf", 0.0).first;
  const auto segments =
      surface.add_property_map<Mesh::Face_index, std::size_t>("f:segment", 0).first;
  CGAL::sdf_values(surface, values);
  CGAL::segmentation_from_sdf_values(surface, values, segments, options.clusters,
                                     options.smoothing);
  std::vector<int> labels;
  for (const Mesh::Face_index face : surface.faces()) {
    labels.push_back(static_cast<int>(segments[face]));
  }
  return labels;
}

}  // namespace morsel::bench
