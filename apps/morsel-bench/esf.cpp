#include "esf.hpp"

#include <pcl/features/esf.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <iterator>
#include <memory>

namespace morsel::bench {

bool has_esf() { return true; }

std::vector<float> esf(std::span<const Vec3> points) {
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Vec3& p : points) {
    cloud->push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  pcl::ESFEstimation<pcl::PointXYZ, pcl::ESFSignature640> estimation;
  estimation.setInputCloud(cloud);
  pcl::PointCloud<pcl::ESFSignature640> result;
  estimation.compute(result);
  const auto& histogram = result.at(0).histogram;
  return {std::begin(histogram), std::end(histogram)};
}

}  // namespace morsel::bench
