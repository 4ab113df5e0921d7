// Source: M. Fischler, R. Bolles, "Random Sample Consensus", CACM 1981, for the first guess.
#include "ground/plane.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/quantile.hpp"
#include "base/random.hpp"
#include "base/spatial_order.hpp"
#include "denoise/planes.hpp"

namespace morsel {
namespace {

constexpr int kGuesses = 2000;
constexpr std::size_t kJury = 512;  // points that a guess is judged by
constexpr double kReach = 0.01;     // of a guessed plane, over the cloud's diagonal
constexpr double kExact = 1e-5;     // of the diagonal: what rounding leaves of an exact plane
constexpr int kFits = 12;

struct Support {
  double on = 0.0;
  double above = 0.0;
  double beneath = 0.0;
};

Support support_of(std::span<const Vec3> points, const GroundPlane& plane) {
  Support support;
  for (const Vec3& p : points) {
    const double height = plane.height(p);
    support.on += std::abs(height) <= plane.thickness ? 1.0 : 0.0;
    support.above += height > plane.thickness ? 1.0 : 0.0;
    support.beneath += height < -plane.thickness ? 1.0 : 0.0;
  }
  return support;
}

// A few points, each coordinate by itself: many planes are held against them. The first of them are
// spread as evenly as all.
class Jury {
 public:
  explicit Jury(const std::vector<Vec3>& points) {
    for (std::size_t first = 0; first < kTurns; ++first) {
      for (std::size_t i = first; i < points.size(); i += kTurns) {
        x_.push_back(points[i].x);
        y_.push_back(points[i].y);
        z_.push_back(points[i].z);
      }
    }
  }

  // What speaks for the plane of the ground; 0 if the first of them find nothing, as most often.
  [[nodiscard]] double value_of(const GroundPlane& plane) const {
    const auto value = [&](std::size_t count) {
      const Support support = support_of(plane, count);
      return support.on - std::min(support.above, support.beneath);
    };
    if (x_.size() >= kJury && !(value(kJury / kTurns) > 0.0)) return 0.0;
    return value(x_.size());
  }

 private:
  static constexpr std::size_t kTurns = 4;

  // As the other support_of(), of the first `count`, in a loop without branches.
  [[nodiscard]] Support support_of(const GroundPlane& plane, std::size_t count) const {
    const auto is_negative = [](double value) { return std::bit_cast<std::uint64_t>(value) >> 63; };
    const auto [nx, ny, nz] = plane.normal;
    std::uint64_t above = 0;
    std::uint64_t beneath = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double height = nx * x_[i] + ny * y_[i] + nz * z_[i] - plane.offset;
      above += is_negative(plane.thickness - height);
      beneath += is_negative(height + plane.thickness);
    }
    return {static_cast<double>(count - above - beneath), static_cast<double>(above),
            static_cast<double>(beneath)};
  }

  std::vector<double> x_, y_, z_;
};

// Of planes through three random points that for which most speaks.
std::optional<GroundPlane> guess_plane(std::span<const Vec3> points, double reach) {
  const Jury jury(evenly_chosen(points, kJury));
  Random random(1);
  const auto pick = [&] { return points[random.below(points.size())]; };
  std::optional<GroundPlane> best;
  double most = 0.0;
  for (int guess = 0; guess < kGuesses; ++guess) {
    const Vec3 a = pick();
    const Vec3 b = pick();
    const Vec3 normal = cross(b - a, pick() - a);
    const double length = norm(normal);
    if (!(length > 0.0)) continue;
    GroundPlane plane{(1.0 / length) * normal, 0.0, reach};
    plane.offset = dot(plane.normal, a);
    const double value = jury.value_of(plane);
    if (value <= most) continue;
    most = value;
    best = plane;
  }
  return best;
}

// The heights of the points that lie on the plane.
std::vector<double> heights_on(std::span<const Vec3> points, const GroundPlane& plane) {
  std::vector<double> heights;
  for (const Vec3& p : points) {
    const double height = plane.height(p);
    if (std::abs(height) <= plane.thickness) heights.push_back(height);
  }
  return heights;
}

// Through the points that lie on it, and as thick as their noise asks for; never thicker than
// before.
GroundPlane fit(std::span<const Vec3> points, const GroundPlane& plane, double least) {
  constexpr double kThickness = 4.0 * 1.4826;  // over the median height: four standard deviations
  std::vector<Vec3> on;
  Vec3 sum;
  for (const Vec3& p : points) {
    if (std::abs(plane.height(p)) > plane.thickness) continue;
    on.push_back(p - points.front());
    sum = sum + on.back();
  }
  if (on.size() < 3) return plane;
  const Vec3 mean = (1.0 / static_cast<double>(on.size())) * sum;
  Scatter scatter;
  for (const Vec3& p : on) scatter.add(p - mean);
  GroundPlane fitted = plane;
  fitted.normal = scatter.shortest().direction;
  if (dot(fitted.normal, plane.normal) < 0.0) fitted.normal = -1.0 * fitted.normal;
  fitted.offset = dot(fitted.normal, points.front() + mean);
  // Not the mean: the upper face of a thin thing that lies on the ground draws that up.
  fitted.offset += quantile(heights_on(points, fitted), 0.5);
  std::vector<double> heights = heights_on(points, fitted);
  for (double& height : heights) height = std::abs(height);
  fitted.thickness = std::clamp(kThickness * quantile(heights, 0.5), least, plane.thickness);
  return fitted;
}

// Of its points' heights: 3 for Gaussian noise, 1 for the two faces of a thin plate.
double kurtosis_of(const std::vector<double>& heights) {
  double second = 0.0;
  double fourth = 0.0;
  for (const double h : heights) {
    second += h * h;
    fourth += h * h * h * h;
  }
  return second > 0.0 ? static_cast<double>(heights.size()) * fourth / (second * second) : 3.0;
}

// The share of the directions in which the plane reaches farther than what stands on it.
double open_sides(std::span<const Vec3> points, const GroundPlane& plane) {
  constexpr std::size_t kSectors = 16;
  constexpr double kFarther = 1.15;
  constexpr double kMost = 0.95;  // of the points; the rest may be strays
  const auto [u, v] = plane_axes(plane);
  std::vector<double> along_u;
  std::vector<double> along_v;
  for (const Vec3& p : points) {
    if (plane.height(p) <= plane.thickness) continue;
    along_u.push_back(dot(u, p));
    along_v.push_back(dot(v, p));
  }
  const auto middle = [&](const std::vector<double>& values) {
    return 0.5 * (quantile(values, 1.0 - kMost) + quantile(values, kMost));
  };
  const double middle_u = middle(along_u);
  const double middle_v = middle(along_v);
  std::array<std::vector<double>, kSectors> ground;
  std::array<std::vector<double>, kSectors> standing;
  for (const Vec3& p : points) {
    const double x = dot(u, p) - middle_u;
    const double y = dot(v, p) - middle_v;
    const double turn = 0.5 + std::atan2(y, x) / (2.0 * std::numbers::pi);
    const auto sector = std::min(kSectors - 1, static_cast<std::size_t>(turn * kSectors));
    const double height = plane.height(p);
    if (height < -plane.thickness) continue;
    (height > plane.thickness ? standing : ground)[sector].push_back(std::hypot(x, y));
  }
  double open = 0.0;
  for (std::size_t s = 0; s < kSectors; ++s) {
    const bool farther = quantile(ground[s], kMost) > kFarther * quantile(standing[s], kMost);
    open += farther ? 1.0 / static_cast<double>(kSectors) : 0.0;
  }
  return open;
}

}  // namespace

std::optional<GroundPlane> find_plane(std::span<const Vec3> points, double diagonal) {
  if (points.size() < 3) return std::nullopt;
  std::optional<GroundPlane> plane = guess_plane(points, kReach * diagonal);
  if (!plane) return plane;
  for (int i = 0; i < kFits; ++i) *plane = fit(points, *plane, kExact * diagonal);
  const Support support = support_of(points, *plane);
  if (support.beneath > support.above) {
    plane->normal = -1.0 * plane->normal;
    plane->offset = -plane->offset;
  }
  return plane;
}

bool is_unmistakable(std::span<const Vec3> points, const GroundPlane& plane, double diagonal) {
  constexpr double kFairShare = 0.08;
  constexpr double kLeastAbove = 0.01;   // of all points; else there is nothing but the plane
  constexpr double kMostBeneath = 0.02;  // over those above; strays
  constexpr double kLeastKurtosis = 2.0;
  constexpr double kOpenSides = 0.85;
  const Support support = support_of(points, plane);
  const auto count = static_cast<double>(points.size());
  if (support.on < kFairShare * count || support.above < kLeastAbove * count) return false;
  if (support.beneath > kMostBeneath * support.above) return false;
  const bool exact = plane.thickness <= kExact * diagonal;
  if (!exact && kurtosis_of(heights_on(points, plane)) < kLeastKurtosis) return false;
  return open_sides(points, plane) >= kOpenSides;
}

std::array<Vec3, 2> plane_axes(const GroundPlane& plane) {
  const Vec3& n = plane.normal;
  const Vec3 u = cross(n, std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const Vec3 unit = (1.0 / norm(u)) * u;
  return {unit, cross(n, unit)};
}

}  // namespace morsel
