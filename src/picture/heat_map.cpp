// A table of similarities as a picture.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <morsel/error.hpp>
#include <morsel/picture.hpp>
#include <string>

#include "picture/text.hpp"

namespace morsel {
namespace {

constexpr std::size_t kLargestSide = 1600;  // pixels of all cells of a row, where they may shrink
constexpr std::size_t kLargestCell = 28;
constexpr std::size_t kSmallestLabelled = 9;  // rows below this height have no names
constexpr std::size_t kMargin = 8;
constexpr float kWidestName = 260.0F;

// Equal steps of a scale that grows in lightness and can be told apart by colour-blind people.
// Source: S. van der Walt, N. Smith, "viridis", matplotlib 1.5, 2015 (nine of its colours).
constexpr std::array<Color, 9> kScale{{{68, 1, 84},
                                       {71, 44, 122},
                                       {59, 81, 139},
                                       {44, 113, 142},
                                       {33, 144, 141},
                                       {39, 173, 129},
                                       {92, 200, 99},
                                       {170, 220, 50},
                                       {253, 231, 37}}};

Color color_of(double value) {
  const double at = std::clamp(value, 0.0, 1.0) * static_cast<double>(kScale.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), kScale.size() - 2);
  const double share = at - static_cast<double>(below);
  Color color{};
  for (std::size_t c = 0; c < color.size(); ++c) {
    const double mixed = (1.0 - share) * kScale[below][c] + share * kScale[below + 1][c];
    color[c] = static_cast<std::uint8_t>(std::lround(mixed));
  }
  return color;
}

void fill(Image& image, std::size_t left, std::size_t top, std::size_t size, const Color& color) {
  for (std::size_t y = top; y < top + size; ++y) {
    for (std::size_t x = left; x < left + size; ++x) {
      std::copy(color.begin(), color.end(),
                image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * (y * image.width + x)));
    }
  }
}

}  // namespace

Image draw_heat_map(std::span<const double> values, std::span<const std::string> names) {
  const std::size_t count = names.size();
  if (count == 0 || values.size() != count * count) {
    throw Error(ErrorCode::kUsage, "heat map: " + std::to_string(values.size()) + " values for " +
                                       std::to_string(count) +
                                       " names; give one name or more and a value for each two");
  }
  const std::size_t cell = std::clamp<std::size_t>(kLargestSide / count, 1, kLargestCell);
  const bool labelled = cell >= kSmallestLabelled;
  const float text_size = std::min(13.0F, static_cast<float>(cell));
  float widest = 0.0F;
  for (const std::string& name : names) {
    if (labelled) widest = std::max(widest, picture::text_width(name, text_size));
  }
  widest = std::min(widest, kWidestName);
  const std::size_t left = kMargin + (labelled ? static_cast<std::size_t>(widest) + kMargin : 0);
  Image image{left + count * cell + kMargin, count * cell + 2 * kMargin, {}};
  image.rgb.assign(image.width * image.height * 3, 255);
  for (std::size_t row = 0; row < count; ++row) {
    const std::size_t top = kMargin + row * cell;
    for (std::size_t column = 0; column < count; ++column) {
      fill(image, left + column * cell, top, cell, color_of(values[row * count + column]));
    }
    if (!labelled) continue;
    const float baseline =
        static_cast<float>(top) + 0.5F * (static_cast<float>(cell) + 0.7F * text_size);
    picture::draw_text(image, picture::fit_text(names[row], text_size, widest), kMargin, baseline,
                       text_size);
  }
  return image;
}

}  // namespace morsel
