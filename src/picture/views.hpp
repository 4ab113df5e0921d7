// Where to look from: upright views of an object in any pose.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace morsel::picture {

/// `count` rotations (1 … 4) from the object's frame to the viewer's: x right, y up, z towards the
/// viewer. Never a mirror image. The object is stood on what looks like its base and first seen
/// from three quarters, broad side on; then from the other side, from above and from behind.
/// Cost: O(1); looks at no more than about 4000 points.
[[nodiscard]] std::vector<Eigen::Matrix3f> choose_views(const std::vector<Eigen::Vector3f>& points,
                                                        std::size_t count);

}  // namespace morsel::picture
