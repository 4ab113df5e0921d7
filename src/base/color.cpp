#include <cstddef>
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

}  // namespace

Color part_color(int part) noexcept {
  return part < 0 ? kUnlabelled : kPalette[static_cast<std::size_t>(part) % kPalette.size()];
}

}  // namespace morsel
