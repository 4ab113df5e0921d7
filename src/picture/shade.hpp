// Light, shadow and lines: from the visible surface to colours.
#pragma once

#include <cstddef>
#include <morsel/color.hpp>
#include <morsel/picture.hpp>
#include <vector>

#include "picture/raster.hpp"

namespace morsel::picture {

/// Lengths in the surface's own (supersampled) pixels.
struct Style {
  float object_size = 1.0F;    ///< longest extent of the object
  float outline_width = 1.0F;  ///< of the dark line around silhouettes
  float border_width = 1.0F;   ///< half the width of the line between two parts
};

/// Shades the surface and draws it into `image` with its top left corner at (left, top), averaging
/// factor x factor samples a pixel, on white.
/// Cost: O(covered pixels), on all cores.
void draw_surface(const Surface& surface, const Style& style, std::size_t factor, Image& image,
                  std::size_t left, std::size_t top);

/// The light and the lines of a drawing, for those who draw it with shapes; one value a pixel.
struct Tones {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<float> light;  ///< mean over the pixel's surface, 0 … about 1.2; 0 off the surface
  std::vector<float> line;   ///< share of the pixel that silhouette lines cover
};

/// The same light and lines as draw_surface. Cost: O(covered pixels), on all cores.
[[nodiscard]] Tones measure_tones(const Surface& surface, const Style& style, std::size_t factor);

/// The colour of a part in the given light.
[[nodiscard]] Color toned_color(int part, float light);

/// The colour of the line around a part, and of silhouettes.
[[nodiscard]] Color border_color(int part);
[[nodiscard]] Color line_color();

}  // namespace morsel::picture
