#include "supervoxels.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/mst_orient_normals.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/cpc_segmentation.h>
#include <pcl/segmentation/lccp_segmentation.h>
#include <pcl/segmentation/supervoxel_clustering.h>

#include <cstddef>
#include <map>
#include <memory>
#include <numeric>

#include "base/box.hpp"
#include "base/point_tree.hpp"

namespace morsel::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = pcl::PointXYZRGBA;
using Cloud = pcl::PointCloud<Point>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Labeled = pcl::PointCloud<pcl::PointXYZL>;

struct Supervoxels {
  std::map<std::uint32_t, pcl::Supervoxel<Point>::Ptr> clusters;
  std::multimap<std::uint32_t, std::uint32_t> neighbors;
  Labeled::Ptr points;  // 0 means without a label
};

Cloud::Ptr to_pcl(std::span<const Vec3> points) {
  auto cloud = std::make_shared<Cloud>();
  for (const Vec3& p : points) {
    Point point;
    point.x = static_cast<float>(p.x);
    point.y = static_cast<float>(p.y);
    point.z = static_cast<float>(p.z);
    cloud->push_back(point);
  }
  return cloud;
}

Normals::Ptr oriented_normals(std::span<const Vec3> points, unsigned neighbors) {
  std::vector<Kernel::Point_3> places;
  for (const Vec3& p : points) places.emplace_back(p.x, p.y, p.z);
  std::vector<Kernel::Vector_3> normals(points.size(), CGAL::NULL_VECTOR);
  std::vector<std::size_t> order(points.size());  // CGAL puts it into another one
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto maps = CGAL::parameters::point_map(CGAL::make_property_map(places))
                        .normal_map(CGAL::make_property_map(normals));
  CGAL::pca_estimate_normals<CGAL::Sequential_tag>(order, neighbors, maps);
  CGAL::mst_orient_normals(order, neighbors, maps);
  auto result = std::make_shared<Normals>();
  for (const Kernel::Vector_3& n : normals) {
    result->push_back(
        {static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z())});
  }
  return result;
}

Supervoxels find_supervoxels(std::span<const Vec3> points, const SupervoxelOptions& options) {
  const double diagonal = bounding_box(points).diagonal();
  pcl::SupervoxelClustering<Point> clustering(static_cast<float>(options.voxel * diagonal),
                                              static_cast<float>(options.supervoxel * diagonal));
  clustering.setUseSingleCameraTransform(false);
  clustering.setInputCloud(to_pcl(points));
  clustering.setNormalCloud(oriented_normals(points, options.normal_neighbors));
  clustering.setColorImportance(0.0F);
  clustering.setSpatialImportance(0.4F);
  clustering.setNormalImportance(1.0F);
  Supervoxels result;
  clustering.extract(result.clusters);
  clustering.getSupervoxelAdjacency(result.neighbors);
  result.points = clustering.getLabeledCloud();
  return result;
}

// Those without a label take that of the nearest one with a label; one label if none has any.
std::vector<int> complete(std::span<const Vec3> points, const Labeled& labeled) {
  std::vector<int> labels;
  std::vector<Vec3> known;
  std::vector<int> known_labels;
  for (std::size_t i = 0; i < points.size(); ++i) {
    labels.push_back(static_cast<int>(labeled[i].label));
    if (labels[i] == 0) continue;
    known.push_back(points[i]);
    known_labels.push_back(labels[i]);
  }
  if (known.empty()) return labels;
  const PointTree tree(known);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (labels[i] == 0) labels[i] = known_labels[tree.nearest(points[i]).index];
  }
  return labels;
}

template <typename Method>
std::vector<int> group(Method& method, std::span<const Vec3> points,
                       const SupervoxelOptions& options) {
  const Supervoxels supervoxels = find_supervoxels(points, options);
  method.setConcavityToleranceThreshold(static_cast<float>(options.concavity));
  method.setKFactor(options.common_convex);
  method.setSanityCheck(options.sanity);
  method.setMinSegmentSize(options.smallest);
  method.setInputSupervoxels(supervoxels.clusters, supervoxels.neighbors);
  method.segment();
  method.relabelCloud(*supervoxels.points);
  return complete(points, *supervoxels.points);
}

}  // namespace

bool has_supervoxels() { return true; }

std::vector<int> lccp_labels(std::span<const Vec3> points, const SupervoxelOptions& options) {
  pcl::LCCPSegmentation<Point> method;
  return group(method, points, options);
}

std::vector<int> cpc_labels(std::span<const Vec3> points, const SupervoxelOptions& options) {
  pcl::CPCSegmentation<Point> method;
  method.setCutting(options.cuts, options.smallest_to_cut, static_cast<float>(options.cut_score));
  return group(method, points, options);
}

}  // namespace morsel::bench
