// Which view goes where in a picture, and how large.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "picture/surfels.hpp"

namespace morsel::picture {

/// One view and its cell of the picture, in pixels from the top left.
struct Cell {
  Eigen::Matrix3f rotation;
  Eigen::Vector2f center;  ///< of the object in this view, rotated units
  std::size_t left = 0;
  std::size_t top = 0;
  std::size_t width = 0;
  std::size_t height = 0;
};

struct Layout {
  float scale = 1.0F;  ///< pixels of one unit, the same in all views
  std::size_t height = 0;
  std::vector<Cell> cells;
  float object_size = 1.0F;  ///< longest extent of the object in any view, pixels
};

/// Arranges the views in one or two rows, whichever shows the object larger, in a picture of the
/// given width, below `top` rows for the title. The picture gets no higher than wide, apart
/// from the title.
[[nodiscard]] Layout arrange(const std::vector<Surfel>& surfels,
                             const std::vector<Eigen::Matrix3f>& views, std::size_t width,
                             std::size_t top);

}  // namespace morsel::picture
