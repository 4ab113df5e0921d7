// Point clouds of known shapes for the tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <numbers>
#include <numeric>
#include <vector>

#include "base/noise.hpp"
#include "base/random.hpp"

namespace morsel::shapes {

using Points = std::vector<Vec3>;
using Matrix = std::array<Vec3, 3>;  // rows

inline Vec3 random_direction(Random& random) {
  const Vec3 v{random.normal(), random.normal(), random.normal()};
  return (1.0 / norm(v)) * v;
}

inline Vec3 random_in_cube(Random& random) {
  const double x = random.uniform();
  const double y = random.uniform();
  return {x, y, random.uniform()};
}

/// Uniform on [0, 1)^3.
inline Points cube_cloud(std::size_t count, std::uint64_t seed = 1) {
  Random random(seed);
  Points points(count);
  for (Vec3& p : points) p = random_in_cube(random);
  return points;
}

/// All points of {0 … side - 1}^3.
inline Points grid(int side) {
  Points points;
  for (int i = 0; i < side * side * side; ++i) {
    const int row = i / side;
    const int layer = row / side;
    points.push_back({static_cast<double>(i % side), static_cast<double>(row % side),
                      static_cast<double>(layer)});
  }
  return points;
}

/// Uniform on a sphere.
inline Points sphere(std::size_t count, const Vec3& center = {}, double radius = 1.0,
                     std::uint64_t seed = 1) {
  Random random(seed);
  Points points(count);
  for (Vec3& p : points) p = center + radius * random_direction(random);
  return points;
}

/// Evenly spread on a sphere (Fibonacci lattice).
inline Points even_sphere(std::size_t count, double radius = 1.0) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double r = std::sqrt(1.0 - z * z);
    const double angle = static_cast<double>(i) * std::numbers::pi * (3.0 - std::sqrt(5.0));
    points.push_back(radius * Vec3{r * std::cos(angle), r * std::sin(angle), z});
  }
  return points;
}

/// Uniform on a torus around the z axis.
inline Points torus(std::size_t count, double large, double small, std::uint64_t seed = 1) {
  Random random(seed);
  Points points;
  while (points.size() < count) {
    const double u = 2.0 * std::numbers::pi * random.uniform();
    const double v = 2.0 * std::numbers::pi * random.uniform();
    const double r = large + small * std::cos(v);
    if (random.uniform() * (large + small) > r) continue;
    points.push_back({r * std::cos(u), r * std::sin(u), small * std::sin(v)});
  }
  return points;
}

/// Uniform on the six faces of the box [0, size].
inline Points box(std::size_t count, const Vec3& size, std::uint64_t seed = 1) {
  Random random(seed);
  const double xy = size.x * size.y;
  const double xz = size.x * size.z;
  const double yz = size.y * size.z;
  Points points;
  while (points.size() < count) {
    Vec3 p = random_in_cube(random);
    const double side = static_cast<double>(random.below(2));
    const double face = (xy + xz + yz) * random.uniform();
    (face < xy ? p.z : face < xy + xz ? p.y : p.x) = side;
    points.push_back({p.x * size.x, p.y * size.y, p.z * size.z});
  }
  return points;
}

/// Uniform on two unit balls at x = ±2 and a bar of radius `bar` between them.
inline Points dumbbell(std::size_t count, double bar = 0.3, std::uint64_t seed = 1) {
  constexpr double kBall = 4.0 * std::numbers::pi;
  const double half = 2.0 - std::sqrt(1.0 - bar * bar);
  const double tube = 4.0 * std::numbers::pi * bar * half;
  Random random(seed);
  Points points;
  while (points.size() < count) {
    const double pick = random.uniform() * (2.0 * kBall + tube);
    if (pick < tube) {
      const double angle = 2.0 * std::numbers::pi * random.uniform();
      const double x = half * (2.0 * random.uniform() - 1.0);
      points.push_back({x, bar * std::cos(angle), bar * std::sin(angle)});
    } else {
      const double side = pick < tube + kBall ? -1.0 : 1.0;
      const Vec3 p = Vec3{2.0 * side, 0.0, 0.0} + random_direction(random);
      if (side * p.x < half && std::hypot(p.y, p.z) < bar) continue;
      points.push_back(p);
    }
  }
  return points;
}

/// Gaussian noise in all directions.
inline Points noisy(Points points, double sigma, std::uint64_t seed = 99) {
  Random random(seed);
  add_noise(points, sigma, random);
  return points;
}

inline Points joined(Points a, const Points& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

template <typename Change>
Points changed(Points points, const Change& change) {
  for (Vec3& p : points) p = change(p);
  return points;
}

inline Points moved(const Points& points, const Vec3& by) {
  return changed(points, [&](const Vec3& p) { return p + by; });
}

inline Points scaled(const Points& points, double by) {
  return changed(points, [&](const Vec3& p) { return by * p; });
}

/// A rotation with no zero in its matrix.
inline Matrix rotation() {
  const double a = 0.7;
  const Vec3 axis = (1.0 / std::sqrt(14.0)) * Vec3{1.0, 2.0, 3.0};
  const auto row = [&](const Vec3& e) {
    return std::cos(a) * e - std::sin(a) * cross(axis, e) +
           ((1.0 - std::cos(a)) * dot(axis, e)) * axis;
  };
  return {row({1, 0, 0}), row({0, 1, 0}), row({0, 0, 1})};
}

inline Points turned(const Points& points, const Matrix& m) {
  return changed(points, [&](const Vec3& p) {
    return Vec3{dot(m[0], p), dot(m[1], p), dot(m[2], p)};
  });
}

/// A random order of 0 … count - 1.
inline std::vector<std::uint32_t> permutation(std::size_t count, std::uint64_t seed = 5) {
  Random random(seed);
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

/// result[i] = values[order[i]].
template <typename Value>
std::vector<Value> permuted(const std::vector<Value>& values,
                            const std::vector<std::uint32_t>& order) {
  std::vector<Value> result;
  result.reserve(order.size());
  for (const std::uint32_t i : order) result.push_back(values[i]);
  return result;
}

/// Parts numbered by their first point: two partitions are equal when these are.
inline std::vector<int> renamed(const std::vector<int>& labels) {
  std::vector<int> names;
  std::vector<int> result;
  result.reserve(labels.size());
  for (const int label : labels) {
    const auto at = std::ranges::find(names, label);
    result.push_back(static_cast<int>(at - names.begin()));
    if (at == names.end()) names.push_back(label);
  }
  return result;
}

}  // namespace morsel::shapes
