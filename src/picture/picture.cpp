#include <algorithm>
#include <cmath>
#include <morsel/error.hpp>
#include <morsel/picture.hpp>
#include <string>

#include "base/atomic_file.hpp"
#include "base/lower_case.hpp"
#include "picture/scene.hpp"
#include "picture/shade.hpp"
#include "picture/svg.hpp"
#include "picture/text.hpp"

namespace morsel {
namespace {

constexpr std::size_t kSheetGap = 10;     // pixels around each cell
constexpr std::size_t kCaptionRows = 18;  // below each cell
constexpr float kCaptionSize = 12.0F;

void check_range(const char* field, std::size_t value, std::size_t low, std::size_t high) {
  if (low <= value && value <= high) return;
  throw Error(ErrorCode::kUsage, std::string("picture ") + field + " is " + std::to_string(value) +
                                     "; it must be " + std::to_string(low) + " to " +
                                     std::to_string(high));
}

Image white_image(std::size_t width, std::size_t height) {
  return {width, height, std::vector<std::uint8_t>(width * height * 3, 255)};
}

std::string lower_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

void check_bytes(const Image& image) {
  const std::size_t expected = image.width * image.height * 3;
  if (image.rgb.size() == expected) return;
  throw Error(ErrorCode::kUsage, "image of " + std::to_string(image.width) + " x " +
                                     std::to_string(image.height) + " pixels has " +
                                     std::to_string(image.rgb.size()) + " bytes; it needs " +
                                     std::to_string(expected));
}

void paste(const Image& source, std::size_t left, std::size_t top, Image& target) {
  for (std::size_t row = 0; row < source.height; ++row) {
    std::copy_n(
        source.rgb.begin() + static_cast<std::ptrdiff_t>(row * source.width * 3), source.width * 3,
        target.rgb.begin() + static_cast<std::ptrdiff_t>(((top + row) * target.width + left) * 3));
  }
}

void draw_centered(Image& image, const std::string& text, float center, float baseline, float size,
                   float width) {
  const std::string fitted = picture::fit_text(text, size, width);
  picture::draw_text(image, fitted, center - 0.5F * picture::text_width(fitted, size), baseline,
                     size);
}

}  // namespace

void PictureOptions::check() const {
  check_range("width", width, 64, 8192);
  check_range("views", views, 1, 4);
}

Image render_parts(std::span<const Vec3> points, std::span<const int> labels,
                   const PictureOptions& options) {
  const picture::Scene scene = picture::make_scene(points, labels, options);
  Image image = white_image(options.width, scene.layout.height);
  for (const picture::Cell& cell : scene.layout.cells) {
    const std::size_t factor = picture::supersampling(cell);
    const picture::Surface surface = picture::render_cell(scene, cell, factor);
    picture::draw_surface(surface, picture::style_of(scene, factor), factor, image, cell.left,
                          cell.top);
  }
  if (!options.title.empty()) {
    const auto width = static_cast<float>(image.width);
    draw_centered(image, options.title, 0.5F * width, scene.title_baseline, scene.title_size,
                  0.94F * width);
  }
  return image;
}

void write_picture(const std::filesystem::path& path, std::span<const Vec3> points,
                   std::span<const int> labels, const PictureOptions& options) {
  const std::string extension = lower_extension(path);
  if (extension == ".png") {
    write_png(path, render_parts(points, labels, options));
  } else if (extension == ".svg") {
    const std::string svg = picture::render_svg(points, labels, options);
    AtomicFile file(path);
    file.stream() << svg;
    file.commit();
  } else {
    throw Error(ErrorCode::kUsage, path.string() + ": a picture's name must end in .png or .svg");
  }
}

Image make_sheet(std::span<const Image> cells, std::span<const std::string> captions,
                 std::size_t columns) {
  check_range("columns", columns, 1, 1000);
  if (!captions.empty() && captions.size() != cells.size()) {
    throw Error(ErrorCode::kUsage, "sheet of " + std::to_string(cells.size()) + " pictures has " +
                                       std::to_string(captions.size()) +
                                       " captions; give one each, or none");
  }
  std::size_t cell_width = 0;
  std::size_t cell_height = 0;
  for (const Image& cell : cells) {
    check_bytes(cell);
    cell_width = std::max(cell_width, cell.width);
    cell_height = std::max(cell_height, cell.height);
  }
  const std::size_t step_x = cell_width + kSheetGap;
  const std::size_t step_y = cell_height + kSheetGap + (captions.empty() ? 0 : kCaptionRows);
  const std::size_t rows = (cells.size() + columns - 1) / columns;
  Image sheet = white_image(columns * step_x + kSheetGap, rows * step_y + kSheetGap);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t left = kSheetGap + i % columns * step_x;
    const std::size_t top = kSheetGap + i / columns * step_y;
    paste(cells[i], left + (cell_width - cells[i].width) / 2,
          top + (cell_height - cells[i].height) / 2, sheet);
  }
  for (std::size_t i = 0; i < captions.size(); ++i) {
    const float center = static_cast<float>(kSheetGap + i % columns * step_x) +
                         0.5F * static_cast<float>(cell_width);
    const std::size_t bottom = kSheetGap + i / columns * step_y + cell_height + kCaptionRows - 5;
    draw_centered(sheet, captions[i], center, static_cast<float>(bottom), kCaptionSize,
                  static_cast<float>(cell_width));
  }
  return sheet;
}

}  // namespace morsel
