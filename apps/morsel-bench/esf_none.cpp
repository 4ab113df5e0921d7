// Stands in for esf.cpp where there is no PCL.
#include "esf.hpp"

namespace morsel::bench {

bool has_esf() { return false; }
std::vector<float> esf(std::span<const Vec3>) { return {}; }

}  // namespace morsel::bench
