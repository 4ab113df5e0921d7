// From bare points to surface elements: small oriented ellipses that together close the surface.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel::picture {

/// Points moved and scaled so that their bounding box fits [-1, 1]^3, with their labels. A point p
/// of the input is at (p - center) / scale.
struct Cloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<int> labels;
  Vec3 center = {};
  double scale = 1.0;
};

/// A half-space that cuts off a surfel: what lies further than `reach` along `outward`.
struct Clip {
  Eigen::Vector3f outward = Eigen::Vector3f::Zero();  ///< unit length, or zero for none
  float reach = 0.0F;                                 ///< from the surfel's position
};

/// An ellipse of the surface, or a ball where the points are too few to make a surface.
struct Surfel {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;     ///< unit length, of either sign
  Eigen::Vector3f major;      ///< half axis; its length is the radius of a ball
  Eigen::Vector3f minor;      ///< half axis, perpendicular to `major` and `normal`
  std::array<Clip, 2> clips;  ///< where the surface bends away or ends
  int label = 0;
  bool ball = false;
  bool isolated = false;  ///< far from all others: drawn, but the picture is not fitted to it
};

/// Centres and scales in double precision, so that far or tiny clouds lose nothing. Points that
/// are not finite are left out.
[[nodiscard]] Cloud normalize(std::span<const Vec3> points, std::span<const int> labels);

/// Keeps one point a cell of a grid: the mean of the points of the cell's most common label.
/// Points come out along a Morton curve. Cost: O(n log n).
[[nodiscard]] Cloud merge_on_grid(const Cloud& cloud, float cell);

/// Fits one surfel to the neighbourhood of every point. Cost: O(n log n), on all cores; the result
/// does not depend on their number.
[[nodiscard]] std::vector<Surfel> make_surfels(const Cloud& cloud);

}  // namespace morsel::picture
