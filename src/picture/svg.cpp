#include "picture/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string_view>
#include <vector>

#include "picture/contour.hpp"
#include "picture/scene.hpp"
#include "picture/shade.hpp"
#include "picture/text.hpp"

namespace morsel::picture {
namespace {

constexpr std::size_t kDrawnWidth = 1200;  // pixels
constexpr std::size_t kFactor = 3;         // samples a pixel and direction
constexpr float kTolerance = 0.13F;        // of simplified outlines, pixels
constexpr float kLeastArea = 1.5F;         // of outlines worth drawing, square pixels
constexpr float kLineLevel = 0.55F;        // share of a pixel from which lines are drawn
constexpr int kToneCount = 16;             // shades of a part
constexpr float kBrightest = 1.3F;

// Bands of equal steps to the eye: light of the middle and of the lower end of a band.
float tone_middle(int tone) {
  const float t = (static_cast<float>(tone) + 0.5F) / kToneCount;
  return kBrightest * t * t;
}
float tone_start(int tone) {
  const float t = static_cast<float>(tone) / kToneCount;
  return kBrightest * t * t;
}

struct Box {
  std::size_t left, top, right, bottom;  // right and bottom are one past the end

  [[nodiscard]] std::size_t width() const { return right - left; }
  [[nodiscard]] std::size_t height() const { return bottom - top; }
};

// One part in one view: the share of each pixel of its box that shows it.
struct Patch {
  Box box{};
  std::vector<float> coverage;
};

// Parts in view, in the order of their labels.
std::map<int, Patch> find_patches(const Surface& surface) {
  std::map<int, Patch> patches;
  for (std::size_t y = 0; y < surface.height; ++y) {
    for (std::size_t x = 0; x < surface.width; ++x) {
      const Fragment& fragment = surface.at(x, y);
      if (!fragment.is_surface()) continue;
      const std::size_t column = x / kFactor;
      const std::size_t row = y / kFactor;
      const auto [found, is_new] = patches.try_emplace(fragment.label);
      Box& box = found->second.box;
      if (is_new) box = {column, row, column + 1, row + 1};
      box = {std::min(box.left, column), std::min(box.top, row), std::max(box.right, column + 1),
             std::max(box.bottom, row + 1)};
    }
  }
  for (auto& [label, patch] : patches) {
    patch.coverage.assign(patch.box.width() * patch.box.height(), 0.0F);
  }
  constexpr float kShare = 1.0F / (kFactor * kFactor);
  for (std::size_t y = 0; y < surface.height; ++y) {
    for (std::size_t x = 0; x < surface.width; ++x) {
      const Fragment& fragment = surface.at(x, y);
      if (!fragment.is_surface()) continue;
      Patch& patch = patches.at(fragment.label);
      patch.coverage[(y / kFactor - patch.box.top) * patch.box.width() + x / kFactor -
                     patch.box.left] += kShare;
    }
  }
  return patches;
}

// Light averaged over each pixel's lit neighbours, so that the bands have calm outlines.
std::vector<float> calm_light(const Tones& tones) {
  constexpr std::size_t kReach = 2;
  std::vector<float> calm(tones.light.size(), 0.0F);
  for (std::size_t y = 0; y < tones.height; ++y) {
    for (std::size_t x = 0; x < tones.width; ++x) {
      float sum = 0.0F;
      float count = 0.0F;
      for (std::size_t j = y - std::min(y, kReach); j < std::min(y + kReach + 1, tones.height);
           ++j) {
        for (std::size_t i = x - std::min(x, kReach); i < std::min(x + kReach + 1, tones.width);
             ++i) {
          const float light = tones.light[j * tones.width + i];
          if (light <= 0.0F) continue;
          sum += light;
          count += 1.0F;
        }
      }
      if (count > 0.0F) calm[y * tones.width + x] = sum / count;
    }
  }
  return calm;
}

int tenths(float x) { return static_cast<int>(std::lround(10.0F * x)); }

void append_tenths(std::string& out, int value, bool separate) {
  if (separate && value >= 0) out += ' ';
  fmt::format_to(std::back_inserter(out), "{}{}", value < 0 ? "-" : "", std::abs(value) / 10);
  if (value % 10 != 0) fmt::format_to(std::back_inserter(out), ".{}", std::abs(value) % 10);
}

// Outlines as the data of an SVG path, in pixels with one decimal.
std::string path_data(const std::vector<Loop>& loops, float left, float top) {
  std::string data;
  for (const Loop& loop : loops) {
    if (std::abs(signed_area(loop)) < kLeastArea) continue;
    const Loop simple = simplify(loop, kTolerance);
    int last_x = 0;
    int last_y = 0;
    for (std::size_t i = 0; i < simple.size(); ++i) {
      // Nodes of the fields are the middles of pixels.
      const int x = tenths(simple[i].x() + left + 0.5F);
      const int y = tenths(simple[i].y() + top + 0.5F);
      if (i > 0 && x == last_x && y == last_y) continue;
      if (i < 2) data += i == 0 ? 'M' : 'l';
      append_tenths(data, x - (i == 0 ? 0 : last_x), i >= 2);
      append_tenths(data, y - (i == 0 ? 0 : last_y), true);
      last_x = x;
      last_y = y;
    }
    data += 'z';
  }
  return data;
}

std::string hex(const Color& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

std::string outline(const Patch& patch) {
  Field field{patch.box.width(), patch.box.height(), patch.coverage};
  for (float& value : field.values) value -= 0.5F;
  return path_data(trace_contours(field), static_cast<float>(patch.box.left),
                   static_cast<float>(patch.box.top));
}

// Where the part is lit at least as the tone needs.
std::string tone_outline(const Patch& patch, const std::vector<float>& light, std::size_t width,
                         int tone) {
  const Box& box = patch.box;
  Field field{box.width(), box.height(), patch.coverage};
  for (std::size_t y = 0; y < field.height; ++y) {
    for (std::size_t x = 0; x < field.width; ++x) {
      const float lit = light[(box.top + y) * width + box.left + x];
      float& value = field.values[y * field.width + x];
      value = std::min(value - 0.5F, 20.0F * (lit - tone_start(tone)));
    }
  }
  return path_data(trace_contours(field), static_cast<float>(box.left),
                   static_cast<float>(box.top));
}

// The darkest and brightest tone of a part's pixels.
std::pair<int, int> tone_range(const Patch& patch, const std::vector<float>& light,
                               std::size_t width) {
  int low = kToneCount - 1;
  int high = 0;
  for (std::size_t y = 0; y < patch.box.height(); ++y) {
    for (std::size_t x = 0; x < patch.box.width(); ++x) {
      if (patch.coverage[y * patch.box.width() + x] <= 0.5F) continue;
      const float lit = light[(patch.box.top + y) * width + patch.box.left + x];
      const int tone =
          std::clamp(static_cast<int>(kToneCount * std::sqrt(lit / kBrightest)), 0, kToneCount - 1);
      low = std::min(low, tone);
      high = std::max(high, tone);
    }
  }
  return {low, high};
}

void append_path(std::string& svg, const std::string& data, const Color& color) {
  if (!data.empty()) svg += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", hex(color), data);
}

void append_view(std::string& svg, const Scene& scene, const Cell& cell) {
  const Surface surface = render_cell(scene, cell, kFactor);
  const Style style = style_of(scene, kFactor);
  const Tones tones = measure_tones(surface, style, kFactor);
  const std::vector<float> light = calm_light(tones);
  const std::map<int, Patch> patches = find_patches(surface);
  svg += fmt::format("<g transform=\"translate({} {})\">\n", cell.left, cell.top);
  std::string borders;
  for (const auto& [label, patch] : patches) {
    const std::string data = outline(patch);
    if (data.empty()) continue;
    const auto [low, high] = tone_range(patch, light, tones.width);
    // Its own stroke closes the seams that antialiasing leaves between neighbours.
    const std::string base = hex(toned_color(label, tone_middle(low)));
    svg += fmt::format("<path fill=\"{}\" stroke=\"{}\" stroke-width=\".6\" d=\"{}\"/>\n", base,
                       base, data);
    for (int tone = low + 1; tone <= high; ++tone) {
      append_path(svg, tone_outline(patch, light, tones.width, tone),
                  toned_color(label, tone_middle(tone)));
    }
    borders += fmt::format("<path stroke=\"{}\" d=\"{}\"/>\n", hex(border_color(label)), data);
  }
  svg +=
      fmt::format("<g fill=\"none\" stroke-width=\"{:.1f}\" stroke-linejoin=\"round\">\n{}</g>\n",
                  style.border_width / kFactor, borders);
  Field lines{tones.width, tones.height, tones.line};
  for (float& value : lines.values) value -= kLineLevel;
  append_path(svg, path_data(trace_contours(lines), 0.0F, 0.0F), line_color());
  svg += "</g>\n";
}

// The length of the well-formed UTF-8 sequence that `text` starts with and that XML may hold; 0
// for none.
std::size_t xml_character(std::string_view text) {
  const auto byte = [text](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) return 0;
  unsigned code = first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return 0;
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool forbidden =
      (code >= 0xd800 && code < 0xe000) || code > 0x10ffff || (code & 0xfffeU) == 0xfffeU;
  return overlong || forbidden ? 0 : length;
}

std::string escape_xml(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = xml_character(text);
    switch (text.front()) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += length == 0 ? "\xef\xbf\xbd" : text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

}  // namespace

std::string render_svg(std::span<const Vec3> points, std::span<const int> labels,
                       const PictureOptions& options) {
  options.check();
  // A larger picture is the same drawing, scaled: it has no pixels to show more with.
  PictureOptions drawn = options;
  drawn.width = std::min(options.width, kDrawnWidth);
  const Scene scene = make_scene(points, labels, drawn);
  const std::size_t height = scene.layout.height * options.width / drawn.width;
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" "
      "viewBox=\"0 0 {} {}\" role=\"img\">\n",
      options.width, height, drawn.width, scene.layout.height);
  if (!options.title.empty()) svg += fmt::format("<title>{}</title>\n", escape_xml(options.title));
  svg += "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  if (!options.title.empty()) {
    svg += fmt::format(
        "<text x=\"50%\" y=\"{:.1f}\" font-family=\"sans-serif\" font-size=\"{:.1f}\" "
        "text-anchor=\"middle\" fill=\"{}\">{}</text>\n",
        scene.title_baseline, scene.title_size, hex(kTextColor), escape_xml(options.title));
  }
  for (const Cell& cell : scene.layout.cells) append_view(svg, scene, cell);
  return svg + "</svg>\n";
}

}  // namespace morsel::picture
