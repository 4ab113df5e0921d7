#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <morsel/color.hpp>

namespace morsel {
namespace {

constexpr Color kUnlabelled = {160, 160, 160};

// The first seven are Okabe and Ito's set without black, ordered so that neighbours in the list
// contrast most. Each further colour was chosen from a grid over sRGB to be the farthest in CIELAB
// from all before it, from kUnlabelled, white and black, in the worst case of normal, protanope and
// deuteranope vision (Machado, Oliveira, Fernandes, IEEE TVCG 2009); these differ by lightness too.
constexpr std::array<Color, 24> kPalette = {{
    {0, 158, 115},   {240, 228, 66},  {0, 114, 178},   {213, 94, 0},    {86, 180, 233},
    {230, 159, 0},   {204, 121, 167}, {68, 51, 0},     {204, 221, 255}, {0, 0, 255},
    {238, 238, 119}, {0, 34, 204},    {102, 51, 68},   {187, 170, 85},  {102, 153, 255},
    {34, 17, 153},   {136, 68, 119},  {204, 238, 153}, {153, 68, 0},    {119, 102, 255},
    {85, 0, 85},     {204, 204, 170}, {204, 51, 68},   {17, 85, 187},
}};

// Beyond the table: hues a golden angle apart, in five strengths by turns.
Color further_color(int part) noexcept {
  constexpr std::array<std::array<double, 2>, 5> kStrengths = {
      {{0.75, 0.85}, {0.35, 0.95}, {0.9, 0.55}, {0.55, 0.7}, {0.2, 0.8}}};  // saturation, value
  const auto [saturation, value] = kStrengths[static_cast<std::size_t>(part) % kStrengths.size()];
  const double turns = 0.618033988749895 * part;
  const double hue = 6.0 * (turns - std::floor(turns));
  Color color{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    // Red is full around hue 0, green around 2, blue around 4.
    const double away = std::abs(hue - 2.0 * static_cast<double>(channel));
    const double share = std::clamp(2.0 - std::min(away, 6.0 - away), 0.0, 1.0);
    color[channel] =
        static_cast<std::uint8_t>(std::lround(255.0 * value * (1.0 - saturation * (1.0 - share))));
  }
  return color;
}

}  // namespace

Color part_color(int part) noexcept {
  if (part < 0) return kUnlabelled;
  const auto index = static_cast<std::size_t>(part);
  return index < kPalette.size() ? kPalette[index] : further_color(part);
}

}  // namespace morsel
