#include "picture/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace morsel::picture {
namespace {

// One string a character from ' ' to '~': strokes separated by spaces, each a polyline of digit
// pairs x y on a grid with x 0 … 4, baseline y = 2, small letters up to 6, capitals up to 8.
constexpr std::array<std::string_view, 95> kGlyphs{
    "",
    "2824 2222",
    "1816 3836",
    "1218 3238 0444 0646",
    "473818070615354443321203 2921",
    "0818170708 3343423233 0248",
    "420607182837360403122244",
    "2826",
    "38262432",
    "18262412",
    "2723 0644 0446",
    "2723 0545",
    "2211",
    "0535",
    "2222",
    "0248",
    "123243473818070312 1337",
    "172822 1232",
    "07183847460242",
    "0718384746354443321203 1535",
    "32380444",
    "480805354443321203",
    "4738180703123243443505",
    "084812",
    "15060718384746351504031232434435",
    "0312324347381807061545",
    "2222 2525",
    "2211 2525",
    "370533",
    "0646 0444",
    "073503",
    "07183847462524 2222",
    "433212030718384744242646",
    "0206284642 0444",
    "02083847463505 3544433202",
    "4738180703123243",
    "02083847433202",
    "48080242 0535",
    "480802 0535",
    "47381807031232434525",
    "0208 4248 0545",
    "1838 2822 1232",
    "4843321203",
    "0208 480542",
    "080242",
    "0208254842",
    "02084248",
    "123243473818070312",
    "02083847463505",
    "123243473818070312 2442",
    "02083847463505 2542",
    "473818070615354443321203",
    "0848 2822",
    "080312324348",
    "082248",
    "0812263248",
    "0842 0248",
    "082548 2522",
    "08480242",
    "38282232",
    "0842",
    "18282212",
    "062846",
    "0141",
    "1827",
    "16364542 441403123243",
    "0802 0312324345361605",
    "4536160503123243",
    "4842 4536160503123243",
    "04444536160503123243",
    "382722 1636",
    "4536160503123243 4641301001",
    "0802 0516364542",
    "2622 2828",
    "262110 2828",
    "0802 460442",
    "2822",
    "0602 05162522 25364542",
    "0602 0516364542",
    "123243453616050312",
    "0600 0312324345361605",
    "4640 4536160503123243",
    "0602 042636",
    "45361605143443321203",
    "18132232 0636",
    "0603123243 4642",
    "062246",
    "0612253246",
    "0642 0246",
    "0603123243 4641301001",
    "06460242",
    "38272615242332",
    "2821",
    "18272635242312",
    "05163445",
};
constexpr float kGap = 1.9F;    // between characters, in grid units
constexpr float kSpace = 1.6F;  // width of a blank
constexpr float kHalfStroke = 0.42F;

bool continues_utf8(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::string_view glyph_of(char c) {
  return c >= ' ' && c <= '~' ? kGlyphs[static_cast<std::size_t>(c - ' ')]
                              : kGlyphs[static_cast<std::size_t>('?' - ' ')];
}

struct Span {
  float left;
  float right;
};

// The columns of the grid that a glyph covers.
Span glyph_span(std::string_view glyph) {
  if (glyph.empty()) return {0.0F, kSpace};
  char low = '9';
  char high = '0';
  for (std::size_t i = 0; i < glyph.size(); i += 2) {
    if (glyph[i] == ' ') ++i;
    low = std::min(low, glyph[i]);
    high = std::max(high, glyph[i]);
  }
  return {static_cast<float>(low - '0'), static_cast<float>(high - '0')};
}

struct Segment {
  float x0, y0, x1, y1;
};

float distance_to(const Segment& s, float x, float y) {
  const float dx = s.x1 - s.x0;
  const float dy = s.y1 - s.y0;
  const float square = dx * dx + dy * dy;
  const float t =
      square > 0.0F ? std::clamp(((x - s.x0) * dx + (y - s.y0) * dy) / square, 0.0F, 1.0F) : 0.0F;
  return std::hypot(x - s.x0 - t * dx, y - s.y0 - t * dy);
}

// How much ink lies on the pixels of a rectangle of the image.
struct Ink {
  std::size_t left = 0;
  std::size_t top = 0;
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<float> coverage;
};

std::size_t clip(float x, std::size_t high) {
  return static_cast<std::size_t>(std::clamp(x, 0.0F, static_cast<float>(high)));
}

// An empty rectangle of the image that holds a line of text.
Ink blank_ink(const Image& image, float left, float baseline, float width, float size) {
  Ink ink;
  ink.left = clip(left - size, image.width);
  ink.top = clip(baseline - 1.5F * size, image.height);
  ink.width = clip(left + width + size, image.width) - ink.left;
  ink.height = clip(baseline + size, image.height) - ink.top;
  ink.coverage.assign(ink.width * ink.height, 0.0F);
  return ink;
}

// Adds the segment's coverage of every pixel near it, keeping the larger.
void cover(const Segment& s, float half_width, Ink& ink) {
  const float reach = half_width + 1.0F;
  const auto left = static_cast<float>(ink.left);
  const auto top = static_cast<float>(ink.top);
  const std::size_t bottom = clip(std::max(s.y0, s.y1) - top + reach + 1.0F, ink.height);
  const std::size_t right = clip(std::max(s.x0, s.x1) - left + reach + 1.0F, ink.width);
  for (std::size_t y = clip(std::min(s.y0, s.y1) - top - reach, ink.height); y < bottom; ++y) {
    for (std::size_t x = clip(std::min(s.x0, s.x1) - left - reach, ink.width); x < right; ++x) {
      const float distance =
          distance_to(s, static_cast<float>(x) + left + 0.5F, static_cast<float>(y) + top + 0.5F);
      float& pixel = ink.coverage[y * ink.width + x];
      pixel = std::max(pixel, std::clamp(half_width - distance + 0.5F, 0.0F, 1.0F));
    }
  }
}

void cover_glyph(std::string_view glyph, float left, float baseline, float unit, Ink& ink) {
  const float half_width = std::max(0.55F, kHalfStroke * unit);
  const auto x_at = [&](std::size_t i) { return left + unit * static_cast<float>(glyph[i] - '0'); };
  const auto y_at = [&](std::size_t i) {
    return baseline - unit * static_cast<float>(glyph[i + 1] - '2');
  };
  for (std::size_t i = 0; i + 3 < glyph.size();) {
    if (glyph[i + 2] == ' ') {
      i += 3;
      continue;
    }
    cover({x_at(i), y_at(i), x_at(i + 2), y_at(i + 2)}, half_width, ink);
    i += 2;
  }
}

void blend(const Ink& ink, Image& image) {
  for (std::size_t y = 0; y < ink.height; ++y) {
    for (std::size_t x = 0; x < ink.width; ++x) {
      const float share = ink.coverage[y * ink.width + x];
      std::uint8_t* pixel = &image.rgb[((ink.top + y) * image.width + ink.left + x) * 3];
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto paper = static_cast<float>(pixel[channel]);
        const auto full = static_cast<float>(kTextColor[channel]);
        pixel[channel] = static_cast<std::uint8_t>(std::lround(paper + share * (full - paper)));
      }
    }
  }
}

}  // namespace

float text_width(std::string_view text, float size) {
  float units = 0.0F;
  for (const char c : text) {
    if (continues_utf8(c)) continue;
    const Span span = glyph_span(glyph_of(c));
    units += span.right - span.left + kGap;
  }
  return std::max(0.0F, units - kGap) * size / 8.0F;
}

std::string fit_text(std::string_view text, float size, float width) {
  if (text_width(text, size) <= width) return std::string(text);
  const float dots = text_width(" ...", size);
  while (!text.empty() && text_width(text, size) + dots > width) {
    // Whole characters only.
    while (text.size() > 1 && continues_utf8(text.back())) text.remove_suffix(1);
    text.remove_suffix(1);
  }
  return std::string(text) + "...";
}

void draw_text(Image& image, std::string_view text, float left, float baseline, float size) {
  const float unit = size / 8.0F;
  Ink ink = blank_ink(image, left, baseline, text_width(text, size), size);
  for (const char c : text) {
    if (continues_utf8(c)) continue;
    const std::string_view glyph = glyph_of(c);
    const Span span = glyph_span(glyph);
    cover_glyph(glyph, left - unit * span.left, baseline, unit, ink);
    left += unit * (span.right - span.left + kGap);
  }
  blend(ink, image);
}

}  // namespace morsel::picture
