// morsel: headless pictures of labelled points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <morsel/color.hpp>
#include <morsel/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace morsel {

/// A picture in memory: rows from the top, 3 bytes (sRGB) a pixel, `rgb` of 3 * width * height.
struct Image {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint8_t> rgb;
};

/// What a picture looks like.
struct PictureOptions {
  std::size_t width = 800;  ///< pixels of the whole picture, 64 … 8192
  std::size_t views = 4;    ///< views of the object, 1 … 4: three quarters, other side, top, back
  std::string title = {};   ///< drawn above the views when not empty; PNG shows ASCII only
  /// The object whose upright pose is taken, so that several can be shown from one side; empty: the
  /// one that is drawn.
  std::span<const Vec3> pose_of = {};

  /// Throws Error(kUsage) that names field, value and range.
  void check() const;
};

/// Draws the points, (n, 3) in any unit and pose, as a closed shaded surface in their parts'
/// colours on white. `labels` has one part per point; a negative one is grey. No mesh and no
/// normals are needed; points that are not finite are left out. The object is stood upright and
/// shown at one scale in all views; the height of the picture follows from the object, at most
/// the width plus the title.
/// The same bytes for any number of threads. Thread-safe. Cost: O(n log n).
/// Throws Error(kUsage) for bad options or when the numbers of points and labels differ.
[[nodiscard]] Image render_parts(std::span<const Vec3> points, std::span<const int> labels,
                                 const PictureOptions& options = {});

/// Renders and writes `.png` or `.svg` (by extension), atomically. The SVG is made of vector
/// shapes and holds no picture.
/// Throws Error(kUsage) for another extension and as render_parts, Error(kOutput).
void write_picture(const std::filesystem::path& path, std::span<const Vec3> points,
                   std::span<const int> labels, const PictureOptions& options = {});

/// Writes an image as PNG, atomically. Throws Error(kUsage) for an image without pixels or with
/// another number of bytes than its size says, Error(kOutput).
void write_png(const std::filesystem::path& path, const Image& image);

/// Sets pictures in rows of `columns` cells, each as large as the largest picture and centred in
/// its cell, on white. `captions` go below the pictures: one each, or none at all.
/// Cost: O(pixels of the sheet). Throws Error(kUsage) when `columns` is 0, the numbers of cells
/// and captions differ, or an image's bytes do not match its size.
[[nodiscard]] Image make_sheet(std::span<const Image> cells, std::span<const std::string> captions,
                               std::size_t columns);

/// Draws a square table of values as coloured cells, 0 dark and 1 bright; `names` stand beside the
/// rows where these are high enough. `values` holds names.size()² values row by row; what lies
/// outside [0, 1] is drawn as the nearer of the two.
/// Cost: O(pixels), at most about 2000 a side. Throws Error(kUsage) when the numbers do not fit.
[[nodiscard]] Image draw_heat_map(std::span<const double> values,
                                  std::span<const std::string> names);

}  // namespace morsel
