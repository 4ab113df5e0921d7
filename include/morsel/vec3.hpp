// morsel: a point or vector of 3-space and the few operations that the library needs on it.
#pragma once

#include <cmath>

namespace morsel {

/// A point or vector with double coordinates, in the unit of the input.
struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend bool operator==(const Vec3&, const Vec3&) = default;
};

[[nodiscard]] constexpr Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] constexpr Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] constexpr Vec3 operator*(double s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
[[nodiscard]] constexpr double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] constexpr double squared_norm(const Vec3& a) { return dot(a, a); }
[[nodiscard]] inline double norm(const Vec3& a) { return std::sqrt(squared_norm(a)); }
[[nodiscard]] constexpr double squared_distance(const Vec3& a, const Vec3& b) {
  return squared_norm(a - b);
}
[[nodiscard]] inline double distance(const Vec3& a, const Vec3& b) { return norm(a - b); }
[[nodiscard]] inline bool is_finite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace morsel
