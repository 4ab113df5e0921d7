// morsel: headless pictures of labelled points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <morsel/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace morsel {

/// An sRGB colour, 0 … 255 a channel.
using Color = std::array<std::uint8_t, 3>;

/// The colour of part `part` >= 0; colours of small indices differ for colour-blind people too.
/// A negative part is grey. Repeats only after 24 parts.
[[nodiscard]] Color part_color(int part);

/// A picture in memory: rows from the top, 3 bytes a pixel.
struct Image {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint8_t> rgb;
};

struct PictureOptions {
  std::size_t width = 800;  ///< pixels of the whole picture, 64 … 8192
  std::size_t views = 4;    ///< views of the object, 1 … 4, laid out in a grid
  std::string title;        ///< drawn above the views when not empty
  /// Throws Error(kUsage) that names field, value and range.
  void check() const;
};

/// Draws the points as shaded discs in their parts' colours. `labels` has one part per point.
/// Cost: O(n log n). Throws Error(kUsage).
[[nodiscard]] Image render_parts(std::span<const Vec3> points, std::span<const int> labels,
                                 const PictureOptions& options = {});

/// Renders and writes `.png` or `.svg` (by extension), atomically.
/// Throws Error(kUsage) for another extension, Error(kOutput).
void write_picture(const std::filesystem::path& path, std::span<const Vec3> points,
                   std::span<const int> labels, const PictureOptions& options = {});

/// Writes an image as PNG, atomically. Throws Error(kOutput).
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace morsel
