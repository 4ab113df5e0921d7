#include "shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/box.hpp"
#include "base/random.hpp"

namespace morsel::bench {
namespace {

constexpr double kPi = std::numbers::pi;

double side_area(const Capsule& c) { return 2.0 * kPi * c.radius * distance(c.a, c.b); }
double area(const Capsule& c) { return 4.0 * kPi * c.radius * c.radius + side_area(c); }

Vec3 random_direction(Random& random) {
  const double z = 2.0 * random.uniform() - 1.0;
  const double angle = 2.0 * kPi * random.uniform();
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// Uniform on the surface: the side, or a ball whose halves are set on the two ends.
Vec3 point_on(const Capsule& c, Random& random) {
  const Vec3 axis = c.b - c.a;
  const Vec3 direction = random_direction(random);
  if (random.uniform() * area(c) >= side_area(c)) {
    return (dot(direction, axis) > 0.0 ? c.b : c.a) + c.radius * direction;
  }
  // The part of a random direction square to the axis is uniform around it.
  const Vec3 across = direction - (dot(direction, axis) / squared_norm(axis)) * axis;
  return c.a + random.uniform() * axis + (c.radius / norm(across)) * across;
}

bool inside_another(std::span<const Capsule> capsules, std::size_t own, const Vec3& point) {
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    if (i != own && signed_distance(capsules[i], point) < 0.0) return true;
  }
  return false;
}

void add_noise(std::vector<Vec3>& points, double fraction, Random& random) {
  if (points.empty() || !(fraction > 0.0)) return;
  const double sigma = fraction * bounding_box(points).diagonal();
  for (Vec3& p : points) {
    const double x = random.normal();
    const double y = random.normal();
    const double z = random.normal();
    p = p + sigma * Vec3{x, y, z};
  }
}

}  // namespace

double signed_distance(const Capsule& capsule, const Vec3& point) {
  const Vec3 axis = capsule.b - capsule.a;
  const double length = squared_norm(axis);
  const double t = length > 0.0 ? std::clamp(dot(point - capsule.a, axis) / length, 0.0, 1.0) : 0.0;
  return distance(point, capsule.a + t * axis) - capsule.radius;
}

std::vector<Capsule> beast() {
  return {
      {{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.05}, 0.50},    // body
      {{1.1, 0.0, 0.2}, {1.7, 0.0, 0.85}, 0.22},     // neck
      {{1.75, 0.0, 0.95}, {2.15, 0.0, 0.85}, 0.30},  // head
      {{1.7, 0.18, 1.1}, {1.6, 0.32, 1.5}, 0.08},    // ears
      {{1.7, -0.18, 1.1}, {1.6, -0.32, 1.5}, 0.08},
      {{-1.4, 0.0, 0.1}, {-2.2, 0.1, 0.5}, 0.10},      // tail
      {{0.95, 0.28, -0.2}, {1.05, 0.30, -1.3}, 0.16},  // legs
      {{0.95, -0.28, -0.2}, {0.9, -0.30, -1.3}, 0.16},
      {{-0.95, 0.28, -0.2}, {-1.1, 0.30, -1.3}, 0.16},
      {{-0.95, -0.28, -0.2}, {-0.9, -0.30, -1.3}, 0.16},
  };
}

std::vector<Vec3> sample_union(std::span<const Capsule> capsules, const ShapeOptions& options) {
  Random random(options.seed);
  double total = 0.0;
  for (const Capsule& capsule : capsules) total += area(capsule);
  std::vector<Vec3> points;
  points.reserve(options.count);
  while (points.size() < options.count) {
    double rest = random.uniform() * total;
    std::size_t chosen = 0;
    while (chosen + 1 < capsules.size() && rest >= area(capsules[chosen])) {
      rest -= area(capsules[chosen]);
      ++chosen;
    }
    const Vec3 point = point_on(capsules[chosen], random);
    if (!inside_another(capsules, chosen, point)) points.push_back(point);
  }
  add_noise(points, options.noise, random);
  return points;
}

void bend(std::span<Vec3> points) {
  constexpr double kHeight = 0.06;
  for (Vec3& p : points) {
    const Vec3 wave{std::sin(2.1 * p.y + 1.3 * p.z), std::sin(1.7 * p.z + 1.1 * p.x),
                    std::sin(1.9 * p.x)};
    p = p + kHeight * wave;
  }
}

}  // namespace morsel::bench
