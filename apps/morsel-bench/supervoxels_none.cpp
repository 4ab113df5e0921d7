// Stands in for supervoxels.cpp where there is no PCL.
#include "supervoxels.hpp"

namespace morsel::bench {

bool has_supervoxels() { return false; }
std::vector<int> lccp_labels(std::span<const Vec3>, const SupervoxelOptions&) { return {}; }
std::vector<int> cpc_labels(std::span<const Vec3>, const SupervoxelOptions&) { return {}; }

}  // namespace morsel::bench
