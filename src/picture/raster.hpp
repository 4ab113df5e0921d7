// Surfels to pixels: depth, normal and part of the surface that each pixel sees.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "picture/surfels.hpp"

namespace morsel::picture {

/// An orthographic view; pixel = scale * (rotation * p).xy + offset, with y down.
struct Camera {
  Eigen::Matrix3f rotation;  ///< rows: right, up, towards the viewer
  float scale = 1.0F;        ///< pixels of one unit
  float offset_x = 0.0F;     ///< pixels
  float offset_y = 0.0F;
  std::size_t width = 0;
  std::size_t height = 0;
};

inline constexpr float kBackground = -std::numeric_limits<float>::infinity();

/// What one pixel sees.
struct Fragment {
  float depth = kBackground;  ///< pixels towards the viewer
  float normal_x = 0.0F;      ///< unit normal: right, up; its third component is positive
  float normal_y = 0.0F;
  int label = 0;

  [[nodiscard]] bool is_surface() const { return depth > kBackground; }
};

/// The visible surface; rows from the top.
struct Surface {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<Fragment> fragments;

  [[nodiscard]] const Fragment& at(std::size_t x, std::size_t y) const {
    return fragments[y * width + x];
  }
};

/// Draws the surfels with a depth buffer and blends those that lie on one surface.
/// `smallest` is the least half axis in pixels. Cost: O(surfels + covered pixels), on all cores;
/// the result does not depend on their number.
[[nodiscard]] Surface rasterize(std::span<const Surfel> surfels, const Camera& camera,
                                float smallest);

}  // namespace morsel::picture
