#include "match/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/neighborhoods.hpp"
#include "base/spatial_order.hpp"
#include "denoise/planes.hpp"
#include "signature/landmarks.hpp"

namespace morsel {
namespace {

constexpr std::size_t kNeighbors = 11;  // that give normal and area of a point
constexpr std::size_t kFewPoints = 2 * kNeighbors;
constexpr std::size_t kLandmarks = 100;
constexpr double kReach = 0.6;  // largest radius of surroundings, in sizes of the shape

// The place of a value 0 … 1 between the middles of `bins` bins: the lower one and the share of the
// upper one.
struct Place {
  Place(double value, std::size_t bins) {
    const double at = std::clamp(value * static_cast<double>(bins) - 0.5, 0.0,
                                 static_cast<double>(bins) - 1.000001);
    lower = static_cast<std::size_t>(at);
    upper_share = static_cast<float>(at - static_cast<double>(lower));
  }
  [[nodiscard]] float share(std::size_t k) const {
    return k == 0 ? 1.0F - upper_share : upper_share;
  }
  std::size_t lower;
  float upper_share;
};

void add_area(Surroundings& to, const Place& distance, const Place& height, const Place& angle,
              float area) {
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t row =
          ((distance.lower + i) * kHeightBins + height.lower + k) * kAngleBins + angle.lower;
      const float share = area * distance.share(i) * height.share(k);
      to[row] += share * angle.share(0);
      to[row + 1] += share * angle.share(1);
    }
  }
}

// The surroundings of one landmark at all scales.
void describe(const Surface::Data& surface, std::uint32_t landmark,
              std::array<Surroundings*, kScales>& to) {
  const Vec3& at = surface.points[landmark];
  const Vec3& normal = surface.normals[landmark];
  std::array<double, kScales> radii{};
  for (std::size_t scale = 0; scale < kScales; ++scale) radii[scale] = radius_at(surface, scale);
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Vec3 arm = surface.points[i] - at;
    const double length = norm(arm);
    if (length >= radii[0]) continue;
    const Place height(length > 0.0 ? std::abs(dot(arm, normal)) / length : 0.0, kHeightBins);
    const Place angle(std::abs(dot(surface.normals[i], normal)), kAngleBins);
    for (std::size_t scale = 0; scale < kScales; ++scale) {
      const double radius = radii[scale];
      if (length >= radius) break;
      const double disc = std::numbers::pi * radius * radius;
      add_area(*to[scale], Place(length / radius, kDistanceBins), height, angle,
               static_cast<float>(surface.areas[i] / disc));
    }
  }
  for (Surroundings* surroundings : to) {
    for (float& value : *surroundings) value = std::sqrt(value);
  }
}

// Each point stands for a share of the disc that reaches to the last of its neighbours, evened out
// over them.
std::vector<double> find_areas(const Neighborhoods& neighborhoods) {
  const auto share = [&](std::size_t i) {
    return std::numbers::pi * neighborhoods.reach[i] * neighborhoods.reach[i] /
           static_cast<double>(neighborhoods.size + 1);
  };
  std::vector<double> areas;
  for (std::size_t i = 0; i < neighborhoods.reach.size(); ++i) {
    double sum = share(i);
    for (const std::uint32_t k : neighborhoods.of(i)) sum += share(k);
    areas.push_back(sum / static_cast<double>(neighborhoods.size + 1));
  }
  return areas;
}

void find_size(Surface::Data& surface) {
  const double each = 1.0 / static_cast<double>(surface.points.size());
  for (const Vec3& p : surface.points) surface.center = surface.center + each * p;
  double squares = 0.0;
  for (const Vec3& p : surface.points) squares += each * squared_distance(p, surface.center);
  surface.size = std::sqrt(squares);
  for (const double area : surface.areas) surface.spacing += each * std::sqrt(area);
}

// The points nearest to landmarks that are chosen farthest first.
std::vector<std::uint32_t> choose_landmarks(const Surface::Data& surface) {
  std::vector<std::uint32_t> chosen;
  for (const Vec3& position : find_landmarks(surface.points, surface.center, kLandmarks).position) {
    chosen.push_back(surface.tree->nearest(position).index);
  }
  return chosen;
}

std::shared_ptr<const Surface::Data> prepare(std::span<const Vec3> points,
                                             std::span<const int> parts) {
  auto surface = std::make_shared<Surface::Data>();
  SpatialOrder order = sort_spatially(points);
  if (order.points.size() < kFewPoints) return surface;
  surface->points = std::move(order.points);
  surface->parts.assign(surface->points.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    int& part = surface->parts[order.order_of_point[i]];
    part = std::max(part, parts[i]);
  }
  const Neighborhoods neighborhoods = find_neighborhoods(surface->points, kNeighbors, 1);
  surface->normals = fit_planes(surface->points, neighborhoods, kNeighbors, 1).normal;
  surface->areas = find_areas(neighborhoods);
  find_size(*surface);
  surface->tree.emplace(surface->points);
  surface->landmarks = choose_landmarks(*surface);
  for (auto& of_scale : surface->surroundings) of_scale.resize(surface->landmarks.size());
  for (std::size_t l = 0; l < surface->landmarks.size(); ++l) {
    std::array<Surroundings*, kScales> to{};
    for (std::size_t scale = 0; scale < kScales; ++scale) {
      to[scale] = &surface->surroundings[scale][l];
    }
    describe(*surface, surface->landmarks[l], to);
  }
  return surface;
}

}  // namespace

double radius_at(const Surface::Data& surface, std::size_t scale) {
  return kReach * surface.size * std::pow(kScaleStep, -static_cast<double>(scale));
}

Surface::Surface(std::span<const Vec3> points, std::span<const int> parts)
    : data_(prepare(points, parts)) {}

}  // namespace morsel
