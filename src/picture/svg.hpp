// Pictures as vector shapes.
#pragma once

#include <morsel/picture.hpp>
#include <span>
#include <string>

namespace morsel::picture {

/// The picture as a self-contained SVG document.
[[nodiscard]] std::string render_svg(std::span<const Vec3> points, std::span<const int> labels,
                                     const PictureOptions& options);

}  // namespace morsel::picture
