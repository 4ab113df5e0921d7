// Source: M. Zwicker, H. Pfister, J. van Baar, M. Gross, "Surface splatting", SIGGRAPH 2001: a
// first pass finds the visible depth, a second blends the splats that lie within a tolerance of it.
// Differs: parts are not blended; the part of the largest summed weight wins the pixel.
#include "picture/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/threads.hpp"

namespace morsel::picture {
namespace {

using Eigen::Vector3f;

constexpr std::size_t kBandRows = 32;  // rows drawn by one task
constexpr float kLargestHole = 60.0F;  // half the width of holes that are filled, pixels

// A surfel in pixels. An ellipse is a x² + 2 b x y + c y² <= 1 around the centre.
struct Splat {
  float x, y, z;
  float a, b, c;
  float extent_x, extent_y;  // half the bounding box
  float slope_x, slope_y;    // depth per pixel along the disc
  float extent_z;            // largest depth offset
  Vector3f normal;           // towards the viewer
  std::array<Clip, 2> clips;
  float tolerance;  // depth within which surfaces are one
  int label;
  bool ball;
};

Splat project_ball(const Surfel& surfel, const Camera& camera, float smallest, Splat splat) {
  const float radius = std::max(smallest, camera.scale * surfel.major.norm());
  splat.a = splat.c = 1.0F / (radius * radius);
  splat.b = 0.0F;
  splat.extent_x = splat.extent_y = splat.extent_z = radius;
  splat.slope_x = splat.slope_y = 0.0F;
  splat.normal = Vector3f::UnitZ();
  splat.tolerance = 0.0F;
  return splat;
}

Splat project(const Surfel& surfel, const Camera& camera, float smallest) {
  const Vector3f center = camera.scale * (camera.rotation * surfel.position);
  Splat splat{};
  splat.x = center.x() + camera.offset_x;
  splat.y = camera.offset_y - center.y();
  splat.z = center.z();
  splat.label = surfel.label;
  splat.ball = surfel.ball;
  if (surfel.ball) return project_ball(surfel, camera, smallest, splat);

  const Vector3f major = camera.scale * (camera.rotation * surfel.major);
  const Vector3f minor = camera.scale * (camera.rotation * surfel.minor);
  // The disc's outline has covariance-like matrix M = major majorᵀ + minor minorᵀ in the plane of
  // the picture. The least size keeps discs seen edge-on from vanishing.
  const float xx = major.x() * major.x() + minor.x() * minor.x() + smallest * smallest;
  const float yy = major.y() * major.y() + minor.y() * minor.y() + smallest * smallest;
  const float xy = -(major.x() * major.y() + minor.x() * minor.y());  // y down
  const float determinant = xx * yy - xy * xy;
  splat.a = yy / determinant;
  splat.b = -xy / determinant;
  splat.c = xx / determinant;
  splat.extent_x = std::sqrt(xx);
  splat.extent_y = std::sqrt(yy);
  splat.extent_z = std::hypot(major.z(), minor.z());

  splat.normal = camera.rotation * surfel.normal;
  if (splat.normal.z() < 0.0F) splat.normal = -splat.normal;
  const float facing = std::max(splat.normal.z(), 0.05F);
  splat.slope_x = -splat.normal.x() / facing;
  splat.slope_y = splat.normal.y() / facing;
  for (std::size_t i = 0; i < splat.clips.size(); ++i) {
    splat.clips[i] = {camera.rotation * surfel.clips[i].outward,
                      camera.scale * surfel.clips[i].reach + 0.3F * smallest};
  }
  splat.tolerance = 0.6F * std::max(major.norm(), minor.norm()) + smallest;
  return splat;
}

bool is_clipped(const Splat& splat, const Vector3f& offset) {
  return splat.clips[0].outward.dot(offset) > splat.clips[0].reach ||
         splat.clips[1].outward.dot(offset) > splat.clips[1].reach;
}

// Calls body(column, row, weight in (0, 1], depth, normal) for the splat's pixels in rows
// [first_row, last_row).
template <typename Body>
void for_each_pixel(const Splat& splat, std::size_t width, std::size_t first_row,
                    std::size_t last_row, const Body& body) {
  const auto clip = [](float x, std::size_t low, std::size_t high) {
    return static_cast<std::size_t>(
        std::clamp(x, static_cast<float>(low), static_cast<float>(high)));
  };
  const std::size_t top = clip(std::ceil(splat.y - splat.extent_y - 0.5F), first_row, last_row);
  const std::size_t bottom = clip(std::floor(splat.y + splat.extent_y + 0.5F), first_row, last_row);
  const std::size_t left = clip(std::ceil(splat.x - splat.extent_x - 0.5F), 0, width);
  const std::size_t right = clip(std::floor(splat.x + splat.extent_x + 0.5F), 0, width);
  for (std::size_t row = top; row < bottom; ++row) {
    const float dy = static_cast<float>(row) + 0.5F - splat.y;
    for (std::size_t column = left; column < right; ++column) {
      const float dx = static_cast<float>(column) + 0.5F - splat.x;
      const float square = splat.a * dx * dx + 2.0F * splat.b * dx * dy + splat.c * dy * dy;
      if (square > 1.0F) continue;
      const float weight = 1.0F - square;
      if (splat.ball) {
        const float dz = std::sqrt(weight);
        const Vector3f normal(dx / splat.extent_x, -dy / splat.extent_x, dz);
        body(column, row, weight + 0.01F, splat.z + dz * splat.extent_z, normal);
        continue;
      }
      const float dz =
          std::clamp(splat.slope_x * dx + splat.slope_y * dy, -splat.extent_z, splat.extent_z);
      if (is_clipped(splat, Vector3f(dx, -dy, dz))) continue;
      body(column, row, weight * weight + 0.01F, splat.z + dz, splat.normal);
    }
  }
}

// Which splats touch which band of rows, in the order of the splats.
struct Bands {
  std::vector<std::size_t> begin;  // one more than bands
  std::vector<std::uint32_t> splats;
};

Bands sort_into_bands(const std::vector<Splat>& splats, std::size_t height) {
  const std::size_t count = (height + kBandRows - 1) / kBandRows;
  const auto band_of = [count](float y) {
    return static_cast<std::size_t>(
        std::clamp(y / kBandRows, 0.0F, static_cast<float>(count) - 1.0F));
  };
  Bands bands;
  bands.begin.assign(count + 1, 0);
  const auto for_each_band = [&](const Splat& splat, const auto& body) {
    const std::size_t last = band_of(splat.y + splat.extent_y + 1.0F);
    for (std::size_t i = band_of(splat.y - splat.extent_y - 1.0F); i <= last; ++i) body(i);
  };
  for (const Splat& splat : splats) {
    for_each_band(splat, [&](std::size_t band) { ++bands.begin[band + 1]; });
  }
  for (std::size_t i = 0; i < count; ++i) bands.begin[i + 1] += bands.begin[i];
  bands.splats.resize(bands.begin.back());
  std::vector<std::size_t> next(bands.begin.begin(), bands.begin.end() - 1);
  for (std::size_t i = 0; i < splats.size(); ++i) {
    for_each_band(splats[i], [&](std::size_t band) {
      bands.splats[next[band]++] = static_cast<std::uint32_t>(i);
    });
  }
  return bands;
}

// The running sums of one pixel in the second pass. The two strongest parts are enough to find
// the winner except where three or more meet.
struct Blend {
  float weight = 0.0F;
  float depth = 0.0F;
  Vector3f normal = Vector3f::Zero();
  std::array<int, 2> label{};
  std::array<float, 2> votes{};

  void vote(int part, float share) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (votes[i] == 0.0F || label[i] == part) {
        label[i] = part;
        votes[i] += share;
        return;
      }
    }
    const std::size_t weaker = votes[1] < votes[0] ? 1 : 0;
    votes[weaker] -= share;
    if (votes[weaker] < 0.0F) {
      label[weaker] = part;
      votes[weaker] = -votes[weaker];
    }
  }

  [[nodiscard]] Fragment resolve() const {
    if (weight == 0.0F) return {};
    const Vector3f unit = normal.normalized();
    return {depth / weight, unit.x(), unit.y(), votes[1] > votes[0] ? label[1] : label[0]};
  }
};

void draw_band(const std::vector<Splat>& splats, std::span<const std::uint32_t> touching,
               std::size_t first_row, std::size_t last_row, Surface& surface) {
  const std::size_t width = surface.width;
  std::vector<float> nearest((last_row - first_row) * width, kBackground);
  for (const std::uint32_t i : touching) {
    for_each_pixel(splats[i], width, first_row, last_row,
                   [&](std::size_t x, std::size_t y, float, float depth, const Vector3f&) {
                     float& near = nearest[(y - first_row) * width + x];
                     near = std::max(near, depth);
                   });
  }
  std::vector<Blend> blends(nearest.size());
  for (const std::uint32_t i : touching) {
    const Splat& splat = splats[i];
    for_each_pixel(
        splat, width, first_row, last_row,
        [&](std::size_t x, std::size_t y, float weight, float depth, const Vector3f& normal) {
          const std::size_t pixel = (y - first_row) * width + x;
          if (depth < nearest[pixel] - splat.tolerance) return;
          // Which way a disc seen edge-on faces is a guess, so it counts for little.
          const float share = weight * (normal.z() + 0.05F);
          Blend& blend = blends[pixel];
          blend.weight += share;
          blend.depth += share * depth;
          blend.normal += share * normal;
          blend.vote(splat.label, share);
        });
  }
  for (std::size_t i = 0; i < blends.size(); ++i) {
    surface.fragments[first_row * width + i] = blends[i].resolve();
  }
}

// Where several directions see the surface go on nearer to the viewer, a pixel lies in a hole
// between discs.
class HoleFiller {
 public:
  HoleFiller(Surface& surface, float reach)
      : surface_(surface), reach_(static_cast<std::ptrdiff_t>(std::ceil(reach))), step_(reach) {}

  void fill() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < surface_.fragments.size(); ++i) {
      if (is_below_neighbor(i)) open.push_back(i);
    }
    // Each round fills the rims of the holes that are left.
    for (int round = 0; round < kRounds && !open.empty(); ++round) open = fill_round(open);
  }

 private:
  static constexpr int kRounds = 4;
  static constexpr std::size_t kNeeded = 6;  // of 8 directions
  using Offset = std::array<std::ptrdiff_t, 2>;
  static constexpr std::array<Offset, 8> kDirections{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

  // The index of the pixel `distance` steps away, or of none.
  [[nodiscard]] std::size_t step(std::size_t pixel, const Offset& offset,
                                 std::ptrdiff_t distance) const {
    const auto x = static_cast<std::ptrdiff_t>(pixel % surface_.width) + distance * offset[0];
    const auto y = static_cast<std::ptrdiff_t>(pixel / surface_.width) + distance * offset[1];
    const bool inside = x >= 0 && y >= 0 && x < static_cast<std::ptrdiff_t>(surface_.width) &&
                        y < static_cast<std::ptrdiff_t>(surface_.height);
    return inside ? static_cast<std::size_t>(y) * surface_.width + static_cast<std::size_t>(x)
                  : kNone;
  }

  [[nodiscard]] bool is_nearer(std::size_t other, std::size_t pixel) const {
    return surface_.fragments[other].depth > surface_.fragments[pixel].depth + step_;
  }

  [[nodiscard]] bool is_below_neighbor(std::size_t pixel) const {
    return std::any_of(kDirections.begin(), kDirections.end(), [&](const Offset& offset) {
      const std::size_t other = step(pixel, offset, 1);
      return other != kNone && is_nearer(other, pixel);
    });
  }

  // The mean of the nearer pixels around, or nothing when too few directions have one.
  [[nodiscard]] Fragment patch(std::size_t pixel) const {
    std::array<Fragment, 8> rim;
    std::size_t found = 0;
    for (const Offset& offset : kDirections) {
      for (std::ptrdiff_t distance = 1; distance <= reach_; ++distance) {
        const std::size_t other = step(pixel, offset, distance);
        if (other == kNone) break;
        if (!is_nearer(other, pixel)) continue;
        rim[found++] = surface_.fragments[other];
        break;
      }
    }
    if (found < kNeeded) return {};
    Fragment sum{0.0F, 0.0F, 0.0F, rim[0].label};
    for (std::size_t i = 0; i < found; ++i) {
      const float share = 1.0F / static_cast<float>(found);
      sum.depth += share * rim[i].depth;
      sum.normal_x += share * rim[i].normal_x;
      sum.normal_y += share * rim[i].normal_y;
    }
    return sum;
  }

  std::vector<std::size_t> fill_round(const std::vector<std::size_t>& open) {
    std::vector<std::pair<std::size_t, Fragment>> patches;
    for (const std::size_t pixel : open) {
      const Fragment fragment = patch(pixel);
      if (fragment.is_surface()) patches.emplace_back(pixel, fragment);
    }
    std::vector<std::size_t> next;
    for (const auto& [pixel, fragment] : patches) surface_.fragments[pixel] = fragment;
    for (const auto& [pixel, fragment] : patches) {
      for (const Offset& offset : kDirections) {
        const std::size_t other = step(pixel, offset, 1);
        if (other != kNone && is_nearer(pixel, other)) next.push_back(other);
      }
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    return next;
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  Surface& surface_;
  std::ptrdiff_t reach_;  // pixels
  float step_;            // depth that counts as nearer, pixels
};

// The usual radius of a disc in pixels.
float usual_radius(std::span<const Surfel> surfels, float scale) {
  std::vector<float> radii;
  for (const Surfel& surfel : surfels) {
    if (!surfel.ball) radii.push_back(surfel.major.norm());
  }
  if (radii.empty()) return 0.0F;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return scale * *middle;
}

}  // namespace

Surface rasterize(std::span<const Surfel> surfels, const Camera& camera, float smallest) {
  Surface surface{camera.width, camera.height, {}};
  surface.fragments.resize(camera.width * camera.height);
  std::vector<Splat> splats(surfels.size());
  parallel_rows(surfels.size(), 0,
                [&](std::size_t i) { splats[i] = project(surfels[i], camera, smallest); });
  const Bands bands = sort_into_bands(splats, camera.height);
  parallel_rows(bands.begin.size() - 1, 0, [&](std::size_t band) {
    const std::size_t first_row = band * kBandRows;
    const std::size_t last_row = std::min(first_row + kBandRows, camera.height);
    const std::span<const std::uint32_t> touching(bands.splats.data() + bands.begin[band],
                                                  bands.begin[band + 1] - bands.begin[band]);
    draw_band(splats, touching, first_row, last_row, surface);
  });
  const float radius = usual_radius(surfels, camera.scale);
  if (radius > 0.0F) HoleFiller(surface, std::min(1.3F * radius, kLargestHole)).fill();
  return surface;
}

}  // namespace morsel::picture
