// Source: L. Bavoil, M. Sainz, "Screen space ambient occlusion", NVIDIA 2008, and M. McGuire et
// al., "The Alchemy screen-space ambient obscurance algorithm", HPG 2011: how much of the sky a
// pixel's neighbours in the depth buffer hide.
#include "picture/shade.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/threads.hpp"

namespace morsel::picture {
namespace {

using Eigen::Vector3f;

constexpr std::size_t kOcclusionTaps = 36;  // of each pixel
constexpr float kOcclusionRadius = 0.11F;   // of the object's size
constexpr float kOcclusionStrength = 2.1F;
constexpr float kDepthJump = 0.022F;  // of the object's size: a step worth a line
constexpr float kLineOpacity = 0.88F;
constexpr float kBorderShade = 0.32F;               // of the colour on the line between two parts
const Vector3f kLineColor(0.016F, 0.018F, 0.024F);  // linear
const Vector3f kKeyDirection = Vector3f(-0.46F, 0.55F, 0.70F).normalized();
const Vector3f kFillDirection = Vector3f(0.75F, 0.05F, 0.66F).normalized();

float linear_from_srgb(float x) {
  return x <= 0.04045F ? x / 12.92F : std::pow((x + 0.055F) / 1.055F, 2.4F);
}

float srgb_from_linear(float x) {
  return x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F;
}

std::uint8_t byte_from_linear(float x) {
  return static_cast<std::uint8_t>(
      std::lround(255.0F * srgb_from_linear(std::clamp(x, 0.0F, 1.0F))));
}

Vector3f albedo(int part) {
  static const std::array<float, 256> kLinear = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      table[i] = linear_from_srgb(static_cast<float>(i) / 255.0F);
    }
    return table;
  }();
  const Color color = part_color(part);
  return {kLinear[color[0]], kLinear[color[1]], kLinear[color[2]]};
}

Vector3f normal_of(const Fragment& fragment) {
  const float square =
      1.0F - fragment.normal_x * fragment.normal_x - fragment.normal_y * fragment.normal_y;
  return {fragment.normal_x, fragment.normal_y, std::sqrt(std::max(0.0F, square))};
}

// In [0, 1), spread evenly over neighbouring pixels.
// Source: J. Jimenez, "Next generation post processing in Call of Duty", SIGGRAPH 2014.
float pixel_noise(std::size_t x, std::size_t y) {
  const float inner = 0.06711056F * static_cast<float>(x) + 0.00583715F * static_cast<float>(y);
  const float outer = 52.9829189F * (inner - std::floor(inner));
  return outer - std::floor(outer);
}

// The fragment at an offset, or nullptr outside the surface.
const Fragment* neighbor(const Surface& surface, std::size_t x, std::size_t y, float dx, float dy) {
  const float column = static_cast<float>(x) + 0.5F + dx;
  const float row = static_cast<float>(y) + 0.5F + dy;
  if (column < 0.0F || row < 0.0F) return nullptr;
  const auto i = static_cast<std::size_t>(column);
  const auto j = static_cast<std::size_t>(row);
  return i < surface.width && j < surface.height ? &surface.at(i, j) : nullptr;
}

// 1 in the open, towards 0 in crevices. The samples of a pixel, numbered by `part` of `parts`,
// share the taps of one golden-angle spiral around it.
float sky_visibility(const Surface& surface, std::size_t x, std::size_t y, float radius,
                     std::size_t part, std::size_t parts, float turn) {
  const Fragment& here = surface.at(x, y);
  const Vector3f normal = normal_of(here);
  const std::size_t taps = (kOcclusionTaps + parts - 1) / parts;
  float hidden = 0.0F;
  for (std::size_t i = 0; i < taps; ++i) {
    const auto tap = static_cast<float>(i * parts + part);
    const float angle = 2.0F * std::numbers::pi_v<float> * (turn + 0.618034F * tap);
    const float share = (tap + turn + 0.1F) / static_cast<float>(taps * parts + 1);
    const float reach = radius * share * std::sqrt(share) + 1.0F;
    const float dx = reach * std::cos(angle);
    const float dy = reach * std::sin(angle);
    const Fragment* other = neighbor(surface, x, y, dx, dy);
    if (other == nullptr || !other->is_surface()) continue;
    const Vector3f toward(dx, -dy, other->depth - here.depth);
    const float distance = toward.norm();
    const float falloff = std::max(0.0F, 1.0F - distance / (1.6F * radius));
    hidden += falloff * std::max(0.0F, normal.dot(toward) / distance - 0.12F);
  }
  return std::max(0.0F, 1.0F - kOcclusionStrength * hidden / static_cast<float>(taps));
}

// x to the 32nd.
float sharpen(float x) {
  for (int i = 0; i < 5; ++i) x *= x;
  return x;
}

Vector3f lit(const Vector3f& base, const Vector3f& normal, float sky) {
  const float key = std::max(0.0F, (normal.dot(kKeyDirection) + 0.15F) / 1.15F);
  const float fill = std::max(0.0F, normal.dot(kFillDirection));
  const float above = 0.5F + 0.5F * normal.y();
  const Vector3f ambient = sky * (0.20F + 0.22F * above) * Vector3f(0.96F, 1.0F, 1.06F);
  const float soft_sky = 0.45F + 0.55F * sky;
  const Vector3f direct = soft_sky * (0.74F * key * Vector3f(1.04F, 1.0F, 0.95F) +
                                      0.14F * fill * Vector3f(0.92F, 0.98F, 1.08F));
  const Vector3f halfway = (kKeyDirection + Vector3f::UnitZ()).normalized();
  const float shine = 0.055F * sky * sharpen(std::max(0.0F, normal.dot(halfway)));
  return base.cwiseProduct(ambient + direct) + Vector3f::Constant(shine);
}

// Eight directions around a pixel.
constexpr std::array<std::array<float, 2>, 8> kAround{{{1, 0},
                                                       {0.7071F, 0.7071F},
                                                       {0, 1},
                                                       {-0.7071F, 0.7071F},
                                                       {-1, 0},
                                                       {-0.7071F, -0.7071F},
                                                       {0, -1},
                                                       {0.7071F, -0.7071F}}};

// How strongly a silhouette line covers this pixel, in [0, 1]: it lies behind a nearby edge. The
// line is drawn on the far side, so thin limbs keep their colour.
float silhouette(const Surface& surface, std::size_t x, std::size_t y, const Style& style) {
  const Fragment& here = surface.at(x, y);
  float threshold = kDepthJump * style.object_size;
  if (here.is_surface()) {
    const float facing = std::max(0.1F, normal_of(here).z());
    threshold += 2.0F * style.outline_width * std::sqrt(1.0F - facing * facing) / facing;
  }
  float strength = 0.0F;
  for (const float share : {0.5F, 1.0F}) {
    for (const auto& [dx, dy] : kAround) {
      const float reach = share * style.outline_width;
      const Fragment* other = neighbor(surface, x, y, reach * dx, reach * dy);
      if (other == nullptr || !other->is_surface()) continue;
      if (!here.is_surface()) return 1.0F;
      strength = std::max(strength, (other->depth - here.depth) / threshold - 1.0F);
    }
  }
  return std::min(1.0F, strength);
}

bool is_part_border(const Surface& surface, std::size_t x, std::size_t y, const Style& style) {
  const Fragment& here = surface.at(x, y);
  return std::any_of(kAround.begin(), kAround.end(), [&](const std::array<float, 2>& direction) {
    const Fragment* other = neighbor(surface, x, y, style.border_width * direction[0],
                                     style.border_width * direction[1]);
    return other != nullptr && other->is_surface() && other->label != here.label &&
           std::abs(other->depth - here.depth) < kDepthJump * style.object_size;
  });
}

// Tiles of the surface where a line may run: lines cost more than all other shading, and most of
// a picture has none.
class LineTiles {
 public:
  LineTiles(const Surface& surface, const Style& style)
      : columns_(surface.width / kTile + 1), rows_(surface.height / kTile + 1) {
    std::vector<char> steps(columns_ * rows_, 0);
    // No two samples within a line's width differ by more than this many smallest steps.
    const float step = kDepthJump * style.object_size / (style.outline_width + 2.0F);
    parallel_rows(rows_, 0, [&](std::size_t row) {
      const std::size_t last = std::min((row + 1) * kTile, surface.height);
      for (std::size_t y = row * kTile; y < last; ++y) {
        for (std::size_t x = 0; x < surface.width; ++x) {
          const Fragment& here = surface.at(x, y);
          if ((x + 1 < surface.width && differ(here, surface.at(x + 1, y), step)) ||
              (y + 1 < surface.height && differ(here, surface.at(x, y + 1), step))) {
            steps[row * columns_ + x / kTile] = 1;
          }
        }
      }
    });
    spread(steps);
  }

  [[nodiscard]] bool has_lines(std::size_t x, std::size_t y) const {
    return lines_[y / kTile * columns_ + x / kTile] != 0;
  }

 private:
  static constexpr std::size_t kTile = 8;  // at least the widest line

  static bool differ(const Fragment& a, const Fragment& b, float step) {
    if (a.is_surface() != b.is_surface()) return true;
    return a.is_surface() && (a.label != b.label || std::abs(a.depth - b.depth) > step);
  }

  void spread(const std::vector<char>& steps) {
    lines_.assign(steps.size(), 0);
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t column = 0; column < columns_; ++column) {
        if (steps[row * columns_ + column] == 0) continue;
        for (std::size_t j = std::max(row, std::size_t{1}) - 1; j < std::min(row + 2, rows_); ++j) {
          for (std::size_t i = std::max(column, std::size_t{1}) - 1;
               i < std::min(column + 2, columns_); ++i) {
            lines_[j * columns_ + i] = 1;
          }
        }
      }
    }
  }

  std::size_t columns_;
  std::size_t rows_;
  std::vector<char> lines_;
};

// Colours the samples of one surface.
class Shader {
 public:
  Shader(const Surface& surface, const Style& style, std::size_t factor)
      : surface_(surface), style_(style), factor_(factor), tiles_(surface, style) {}

  // The light on a pixel's surface, and the share of the pixel that lines cover.
  [[nodiscard]] std::array<float, 2> tones(std::size_t column, std::size_t row) const {
    float light = 0.0F;
    float line = 0.0F;
    float surface = 0.0F;
    for (std::size_t part = 0; part < factor_ * factor_; ++part) {
      const std::size_t x = column * factor_ + part % factor_;
      const std::size_t y = row * factor_ + part / factor_;
      if (tiles_.has_lines(x, y)) line += silhouette(surface_, x, y, style_);
      if (!surface_.at(x, y).is_surface()) continue;
      // Without the noise that hides the pattern of taps in pixels: outlines would be ragged.
      light += lit(Vector3f::Ones(), normal_of(surface_.at(x, y)), sky(x, y, part, 0.0F)).mean();
      surface += 1.0F;
    }
    return {light / std::max(1.0F, surface), line / static_cast<float>(factor_ * factor_)};
  }

  // Linear colour of a pixel: the mean of its samples.
  [[nodiscard]] Vector3f pixel(std::size_t column, std::size_t row) const {
    Vector3f sum = Vector3f::Zero();
    const float turn = pixel_noise(column, row);
    for (std::size_t j = 0; j < factor_; ++j) {
      for (std::size_t i = 0; i < factor_; ++i) {
        sum += sample(column * factor_ + i, row * factor_ + j, j * factor_ + i, turn);
      }
    }
    return sum / static_cast<float>(factor_ * factor_);
  }

 private:
  [[nodiscard]] float sky(std::size_t x, std::size_t y, std::size_t part, float turn) const {
    return sky_visibility(surface_, x, y, kOcclusionRadius * style_.object_size, part,
                          factor_ * factor_, turn);
  }

  [[nodiscard]] Vector3f sample(std::size_t x, std::size_t y, std::size_t part, float turn) const {
    const Fragment& here = surface_.at(x, y);
    const bool lines = tiles_.has_lines(x, y);
    Vector3f color = Vector3f::Ones();
    if (here.is_surface()) {
      color = lit(albedo(here.label), normal_of(here), sky(x, y, part, turn));
      if (lines && is_part_border(surface_, x, y, style_)) color *= kBorderShade;
    }
    if (!lines) return color;
    return color + kLineOpacity * silhouette(surface_, x, y, style_) * (kLineColor - color);
  }

  const Surface& surface_;
  Style style_;
  std::size_t factor_;
  LineTiles tiles_;
};

Color color_from_linear(const Vector3f& color) {
  return {byte_from_linear(color.x()), byte_from_linear(color.y()), byte_from_linear(color.z())};
}

}  // namespace

Tones measure_tones(const Surface& surface, const Style& style, std::size_t factor) {
  const Shader shader(surface, style, factor);
  Tones tones{surface.width / factor, surface.height / factor, {}, {}};
  tones.light.resize(tones.width * tones.height);
  tones.line.resize(tones.width * tones.height);
  parallel_rows(tones.height, 0, [&](std::size_t row) {
    for (std::size_t column = 0; column < tones.width; ++column) {
      const std::size_t pixel = row * tones.width + column;
      const auto [light, line] = shader.tones(column, row);
      tones.light[pixel] = light;
      tones.line[pixel] = line;
    }
  });
  return tones;
}

Color toned_color(int part, float light) { return color_from_linear(light * albedo(part)); }

Color border_color(int part) { return color_from_linear(0.8F * kBorderShade * albedo(part)); }

Color line_color() { return color_from_linear(3.0F * kLineColor); }

void draw_surface(const Surface& surface, const Style& style, std::size_t factor, Image& image,
                  std::size_t left, std::size_t top) {
  const Shader shader(surface, style, factor);
  const std::size_t columns = surface.width / factor;
  parallel_rows(surface.height / factor, 0, [&](std::size_t row) {
    std::uint8_t* pixel = &image.rgb[((top + row) * image.width + left) * 3];
    for (std::size_t column = 0; column < columns; ++column, pixel += 3) {
      const Vector3f color = shader.pixel(column, row);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        pixel[channel] = byte_from_linear(color[static_cast<Eigen::Index>(channel)]);
      }
    }
  });
}

}  // namespace morsel::picture
