#include "solids/solid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/box.hpp"
#include "base/noise.hpp"
#include "base/random.hpp"

namespace morsel::solids {
namespace {

constexpr double kInfinity = Box::kInfinity;

// Where a t² + 2 b t + c <= 0, for a > 0.
std::optional<Stretch> between_roots(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0.0)) return std::nullopt;
  const double root = std::sqrt(discriminant);
  return Stretch{(-b - root) / a, (-b + root) / a};
}

std::optional<Stretch> common(const Stretch& a, const Stretch& b) {
  const Stretch both{std::max(a.enter, b.enter), std::min(a.leave, b.leave)};
  if (!(both.enter < both.leave)) return std::nullopt;
  return both;
}

std::optional<Stretch> hull(const std::optional<Stretch>& a, const std::optional<Stretch>& b) {
  if (!a || !b) return a ? a : b;
  return Stretch{std::min(a->enter, b->enter), std::max(a->leave, b->leave)};
}

// Where low <= start + t step <= high.
std::optional<Stretch> in_slab(double start, double step, double low, double high) {
  if (step == 0.0) {
    if (start < low || start > high) return std::nullopt;
    return Stretch{-kInfinity, kInfinity};
  }
  const double first = (low - start) / step;
  const double second = (high - start) / step;
  return Stretch{std::min(first, second), std::max(first, second)};
}

std::optional<Stretch> in_ball(const Vec3& center, double radius, const Vec3& origin,
                               const Vec3& direction) {
  const Vec3 from = origin - center;
  return between_roots(1.0, dot(from, direction), squared_norm(from) - radius * radius);
}

std::optional<Stretch> inside(const Frustum& f, const Vec3& origin, const Vec3& direction) {
  const double length = distance(f.a, f.b);
  if (!(length > 0.0)) return std::nullopt;
  const Vec3 axis = (1.0 / length) * (f.b - f.a);
  const Vec3 from = origin - f.a;
  const double start = dot(from, axis);
  const double step = dot(direction, axis);
  const auto slab = in_slab(start, step, 0.0, length);
  if (!slab) return std::nullopt;
  // |across + t turn| <= radius + t slope, both sides squared; neither is negative in the slab.
  const Vec3 across = from - start * axis;
  const Vec3 turn = direction - step * axis;
  const double growth = (f.radius_b - f.radius_a) / length;
  const double radius = f.radius_a + growth * start;
  const double slope = growth * step;
  const double a = squared_norm(turn) - slope * slope;
  const double b = dot(across, turn) - radius * slope;
  const double c = squared_norm(across) - radius * radius;
  if (a > 0.0) {
    const auto side = between_roots(a, b, c);
    return side ? common(*side, *slab) : std::nullopt;
  }
  if (a == 0.0) {  // along the wall of the cone or the axis of a cylinder
    if (b == 0.0) return c < 0.0 ? slab : std::nullopt;
    const double end = -0.5 * c / b;
    return common(b > 0.0 ? Stretch{-kInfinity, end} : Stretch{end, kInfinity}, *slab);
  }
  // Steeper than the cone: all of the line but what lies between the roots.
  const auto gap = between_roots(-a, -b, -c);
  if (!gap) return slab;
  return hull(common({-kInfinity, gap->enter}, *slab), common({gap->leave, kInfinity}, *slab));
}

std::optional<Stretch> inside(const Limb& limb, const Vec3& origin, const Vec3& direction) {
  auto stretch = hull(in_ball(limb.a, limb.radius_a, origin, direction),
                      in_ball(limb.b, limb.radius_b, origin, direction));
  const double length = distance(limb.a, limb.b);
  const double difference = limb.radius_a - limb.radius_b;
  if (length <= std::abs(difference)) return stretch;
  // Between the circles along which a cone touches the two balls.
  const double sine = difference / length;
  const double cosine = std::sqrt(1.0 - sine * sine);
  const Vec3 axis = (1.0 / length) * (limb.b - limb.a);
  const Frustum between{.a = limb.a + (sine * limb.radius_a) * axis,
                        .b = limb.b + (sine * limb.radius_b) * axis,
                        .radius_a = cosine * limb.radius_a,
                        .radius_b = cosine * limb.radius_b};
  return hull(stretch, inside(between, origin, direction));
}

Vec3 in_frame(const Vec3& v, const Frame& frame) {
  return {dot(v, frame[0]), dot(v, frame[1]), dot(v, frame[2])};
}

std::optional<Stretch> inside(const Ellipsoid& e, const Vec3& origin, const Vec3& direction) {
  const Vec3 from = in_frame(origin - e.center, e.frame);
  const Vec3 along = in_frame(direction, e.frame);
  const Vec3 o{from.x / e.half.x, from.y / e.half.y, from.z / e.half.z};
  const Vec3 d{along.x / e.half.x, along.y / e.half.y, along.z / e.half.z};
  return between_roots(squared_norm(d), dot(o, d), squared_norm(o) - 1.0);
}

std::optional<Stretch> inside(const Block& block, const Vec3& origin, const Vec3& direction) {
  const Vec3 from = in_frame(origin - block.center, block.frame);
  const Vec3 along = in_frame(direction, block.frame);
  auto stretch = in_slab(from.x, along.x, -block.half.x, block.half.x);
  for (const auto& next : {in_slab(from.y, along.y, -block.half.y, block.half.y),
                           in_slab(from.z, along.z, -block.half.z, block.half.z)}) {
    stretch = stretch && next ? common(*stretch, *next) : std::nullopt;
  }
  return stretch;
}

Vec3 random_direction(Random& random) {
  const double z = 2.0 * random.uniform() - 1.0;
  const double angle = 2.0 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// A box that holds a body: what it reaches along each axis at most.
void add_reach(const Body& body, Box& box) {
  const auto add_ball = [&box](const Vec3& center, double radius) {
    box.add(center - Vec3{radius, radius, radius});
    box.add(center + Vec3{radius, radius, radius});
  };
  if (const auto* limb = std::get_if<Limb>(&body)) {
    add_ball(limb->a, limb->radius_a);
    add_ball(limb->b, limb->radius_b);
  } else if (const auto* frustum = std::get_if<Frustum>(&body)) {
    add_ball(frustum->a, frustum->radius_a);
    add_ball(frustum->b, frustum->radius_b);
  } else if (const auto* ellipsoid = std::get_if<Ellipsoid>(&body)) {
    const Vec3& h = ellipsoid->half;
    add_ball(ellipsoid->center, std::max({h.x, h.y, h.z}));
  } else if (const auto* block = std::get_if<Block>(&body)) {
    add_ball(block->center, norm(block->half));
  }
}

// One line through a solid: where it is inside each piece.
using Line = std::vector<std::optional<Stretch>>;

bool within(const std::optional<Stretch>& stretch, double at) {
  return stretch && stretch->enter < at && at < stretch->leave;
}

// The part of the surface that the end `at` of piece `own` lies on; none when it is covered.
std::optional<int> part_at(const Solid& solid, const Line& line, std::size_t own, double at) {
  std::optional<int> part;
  double deepest = 0.0;
  for (std::size_t i = 0; i < solid.size(); ++i) {
    if (i == own || !within(line[i], at)) continue;
    if (solid[i].hole || !solid[own].hole) return std::nullopt;
    const double depth = std::min(at - line[i]->enter, line[i]->leave - at);
    if (depth > deepest) {
      deepest = depth;
      part = solid[i].part;
    }
  }
  return solid[own].hole ? part : std::optional(solid[own].part);
}

}  // namespace

std::optional<Stretch> stretch_inside(const Body& body, const Vec3& origin, const Vec3& direction) {
  return std::visit([&](const auto& shape) { return inside(shape, origin, direction); }, body);
}

Solid beast() {
  const auto capsule = [](const Vec3& a, const Vec3& b, double radius, int part) {
    return Piece{.body = Limb{a, b, radius, radius}, .part = part};
  };
  return {
      capsule({-1.0, 0.0, 0.0}, {1.0, 0.0, 0.05}, 0.50, 0),    // body
      capsule({1.1, 0.0, 0.2}, {1.7, 0.0, 0.85}, 0.22, 1),     // neck
      capsule({1.75, 0.0, 0.95}, {2.15, 0.0, 0.85}, 0.30, 2),  // head
      capsule({1.7, 0.18, 1.1}, {1.6, 0.32, 1.5}, 0.08, 3),    // ears
      capsule({1.7, -0.18, 1.1}, {1.6, -0.32, 1.5}, 0.08, 4),
      capsule({-1.4, 0.0, 0.1}, {-2.2, 0.1, 0.5}, 0.10, 5),      // tail
      capsule({0.95, 0.28, -0.2}, {1.05, 0.30, -1.3}, 0.16, 6),  // legs
      capsule({0.95, -0.28, -0.2}, {0.9, -0.30, -1.3}, 0.16, 7),
      capsule({-0.95, 0.28, -0.2}, {-1.1, 0.30, -1.3}, 0.16, 8),
      capsule({-0.95, -0.28, -0.2}, {-0.9, -0.30, -1.3}, 0.16, 9),
  };
}

LabelledPoints sample(const Solid& solid, const SurfaceOptions& options) {
  Box box;
  for (const Piece& piece : solid) {
    if (!piece.hole) add_reach(piece.body, box);
  }
  const Vec3 center = 0.5 * (box.low + box.high);
  const double radius = 0.5 * box.diagonal();
  Random random(options.seed);
  LabelledPoints result;
  Line line(solid.size());
  while (result.points.size() < options.count) {
    // A random line through the ball: a direction, and a place on the disk across it.
    const Vec3 direction = random_direction(random);
    const Vec3 other = random_direction(random);
    const Vec3 across = other - dot(other, direction) * direction;
    const double off = radius * std::sqrt(random.uniform());
    const Vec3 origin = center + (off / norm(across)) * across;
    for (std::size_t i = 0; i < solid.size(); ++i) {
      line[i] = stretch_inside(solid[i].body, origin, direction);
    }
    for (std::size_t i = 0; i < solid.size(); ++i) {
      if (!line[i]) continue;
      for (const double at : {line[i]->enter, line[i]->leave}) {
        const auto part = part_at(solid, line, i, at);
        if (!part || result.points.size() == options.count) continue;
        result.points.push_back(origin + at * direction);
        result.parts.push_back(*part);
      }
    }
  }
  add_noise(result.points, options.noise * bounding_box(result.points).diagonal(), random);
  return result;
}

void bend(std::span<Vec3> points) {
  constexpr double kHeight = 0.06;
  for (Vec3& p : points) {
    const Vec3 wave{std::sin(2.1 * p.y + 1.3 * p.z), std::sin(1.7 * p.z + 1.1 * p.x),
                    std::sin(1.9 * p.x)};
    p = p + kHeight * wave;
  }
}

}  // namespace morsel::solids
