// What PNG and SVG share: surfels, views and their place in the picture.
#pragma once

#include <morsel/picture.hpp>
#include <span>
#include <vector>

#include "picture/layout.hpp"
#include "picture/raster.hpp"
#include "picture/shade.hpp"
#include "picture/surfels.hpp"

namespace morsel::picture {

struct Scene {
  std::vector<Surfel> surfels;
  Layout layout;
  float title_size = 0.0F;      ///< pixels of a line of the title, 0 without title
  float title_baseline = 0.0F;  ///< pixels from the top
};

/// Throws Error(kUsage) for bad options or when the numbers of points and labels differ.
[[nodiscard]] Scene make_scene(std::span<const Vec3> points, std::span<const int> labels,
                               const PictureOptions& options);

/// Samples a pixel and direction for a cell: 2, or 1 in huge pictures, where memory would run out.
[[nodiscard]] std::size_t supersampling(const Cell& cell);

/// What a cell sees, at `factor` samples a pixel and direction.
[[nodiscard]] Surface render_cell(const Scene& scene, const Cell& cell, std::size_t factor);

/// Widths of lines for a scene at `factor` samples a pixel and direction.
[[nodiscard]] Style style_of(const Scene& scene, std::size_t factor);

}  // namespace morsel::picture
