#include "picture/views.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace morsel::picture {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

constexpr std::size_t kEnoughPoints = 4000;
constexpr float kDegree = std::numbers::pi_v<float> / 180.0F;

// Where a view stands: around the upright axis from the broad side, and above the horizon.
struct Direction {
  float azimuth;
  float elevation;
};
constexpr std::array<Direction, 4> kDirections{{{-32, 20}, {42, 12}, {-40, 62}, {152, 20}}};
constexpr float kBaseHeight = 0.05F;  // of the object's height
constexpr float kSteepest = 68.0F;

std::vector<Vector3f> thin_out(const std::vector<Vector3f>& points) {
  const std::size_t stride = points.size() / kEnoughPoints + 1;
  std::vector<Vector3f> some;
  for (std::size_t i = 0; i < points.size(); i += stride) some.push_back(points[i]);
  return some;
}

// Columns: the directions of largest to smallest spread.
Matrix3f principal_axes(const std::vector<Vector3f>& points) {
  Vector3f mean = Vector3f::Zero();
  for (const Vector3f& p : points) mean += p;
  mean /= static_cast<float>(points.size());
  Matrix3f covariance = Matrix3f::Zero();
  for (const Vector3f& p : points) covariance += (p - mean) * (p - mean).transpose();
  Eigen::SelfAdjointEigenSolver<Matrix3f> solver(covariance);
  return solver.eigenvectors().rowwise().reverse();
}

struct Range {
  float low = std::numeric_limits<float>::infinity();
  float high = -std::numeric_limits<float>::infinity();

  void add(float x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  [[nodiscard]] float size() const { return high > low ? high - low : 0.0F; }
  [[nodiscard]] bool holds(float x) const { return low <= x && x <= high; }
};

// What the points would stand on with `up` upright.
struct Base {
  float stability = 0.0F;  // share of the outline that the base spans; 0 when they would topple
  float weight = 0.0F;     // share of the points in the base
};

// Source: H. Fu et al., "Upright orientation of man-made objects", SIGGRAPH 2008 (static
// stability; one of its several features).
Base find_base(const std::vector<Vector3f>& points, const Vector3f& up) {
  const Vector3f right = up.unitOrthogonal();
  const Vector3f front = right.cross(up);
  Range height;
  for (const Vector3f& p : points) height.add(up.dot(p));
  std::array<Range, 2> whole;
  std::array<Range, 2> low;
  std::array<float, 2> mean{};
  Base base;
  const float share = 1.0F / static_cast<float>(points.size());
  for (const Vector3f& p : points) {
    const std::array<float, 2> flat{right.dot(p), front.dot(p)};
    const bool is_low = up.dot(p) < height.low + kBaseHeight * height.size();
    if (is_low) base.weight += share;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      whole[axis].add(flat[axis]);
      if (is_low) low[axis].add(flat[axis]);
      mean[axis] += share * flat[axis];
    }
  }
  const float area = whole[0].size() * whole[1].size();
  if (area > 0.0F && low[0].holds(mean[0]) && low[1].holds(mean[1])) {
    base.stability = std::sqrt(low[0].size() * low[1].size() / area);
  }
  return base;
}

// Lying on a large top with the legs in the air is as stable as standing, but not what one expects
// of a table.
bool is_upside_down(const std::vector<Vector3f>& points, const Vector3f& up) {
  const Base base = find_base(points, up);
  const Base other = find_base(points, -up);
  return base.weight > 0.25F && base.weight > 2.0F * other.weight &&
         other.stability > 0.5F * base.stability;
}

// Most files have y or z up, so these win unless the object clearly stands better otherwise.
Vector3f choose_up(const std::vector<Vector3f>& points) {
  struct Candidate {
    Vector3f up;
    float bonus;
  };
  Matrix3f axes = principal_axes(points);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    // An eigenvector's sign is arbitrary; prefer the way of the file's axis it is nearest to.
    Eigen::Index strongest = 0;
    axes.col(axis).cwiseAbs().maxCoeff(&strongest);
    if (axes(strongest, axis) < 0.0F) axes.col(axis) = -axes.col(axis);
  }
  std::vector<Candidate> candidates{{Vector3f::UnitY(), 0.7F}, {Vector3f::UnitZ(), 0.6F}};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    candidates.push_back({axes.col(axis), 0.05F});
    candidates.push_back({-axes.col(axis), 0.0F});
  }
  float best_score = -1.0F;
  Vector3f best = Vector3f::UnitY();
  for (const Candidate& candidate : candidates) {
    const float score = find_base(points, candidate.up).stability + candidate.bonus;
    if (score > best_score + 1e-4F) {
      best_score = score;
      best = candidate.up;
    }
  }
  return is_upside_down(points, best) ? Vector3f(-best) : best;
}

// The horizontal direction across which the object is thinnest, towards the viewer's side of the
// file's own axes.
Vector3f choose_front(const std::vector<Vector3f>& points, const Vector3f& up) {
  std::vector<Vector3f> flat = points;
  for (Vector3f& p : flat) p -= up.dot(p) * up;
  // The broadest direction of the flattened points; all of them lie across `up`.
  const Vector3f broad = principal_axes(flat).col(0);
  Vector3f front = broad.cross(up);
  front = front.norm() > 0.5F ? Vector3f(front.normalized()) : up.unitOrthogonal();
  Eigen::Index strongest = 0;
  front.cwiseAbs().maxCoeff(&strongest);
  // File convention: y up looks along -z, z up looks along +y.
  const bool backwards = front[strongest] < 0.0F;
  return backwards ? Vector3f(-front) : front;
}

// How much higher than usual to look from, in degrees: flat things show little from the side.
float extra_elevation(const std::vector<Vector3f>& points, const Vector3f& front,
                      const Vector3f& up) {
  Range height;
  Range depth;
  for (const Vector3f& p : points) {
    height.add(up.dot(p));
    depth.add(front.dot(p));
  }
  const float ratio = height.size() / std::max(depth.size(), 1e-6F);
  return 26.0F * std::clamp(1.25F - 1.6F * ratio, 0.0F, 1.0F);
}

Matrix3f look_from(const Vector3f& front, const Vector3f& up, const Direction& direction) {
  const Vector3f right = up.cross(front);
  const float azimuth = direction.azimuth * kDegree;
  const float elevation = direction.elevation * kDegree;
  const Vector3f level = std::cos(azimuth) * front + std::sin(azimuth) * right;
  const Vector3f toward = std::cos(elevation) * level + std::sin(elevation) * up;
  const Vector3f view_right = up.cross(toward).normalized();
  Matrix3f rotation;
  rotation.row(0) = view_right;
  rotation.row(1) = toward.cross(view_right);
  rotation.row(2) = toward;
  return rotation;
}

}  // namespace

std::vector<Matrix3f> choose_views(const std::vector<Vector3f>& points, std::size_t count) {
  Vector3f up = Vector3f::UnitY();
  Vector3f front = Vector3f::UnitZ();
  float lift = 0.0F;
  if (!points.empty()) {
    const std::vector<Vector3f> some = thin_out(points);
    up = choose_up(some);
    front = choose_front(some, up);
    lift = extra_elevation(some, front, up);
  }
  std::vector<Matrix3f> views;
  for (std::size_t i = 0; i < count; ++i) {
    Direction direction = kDirections[i];
    direction.elevation = std::min(kSteepest, direction.elevation + lift);
    views.push_back(look_from(front, up, direction));
  }
  return views;
}

}  // namespace morsel::picture
