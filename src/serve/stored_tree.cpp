#include "serve/stored_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace morsel::serve {
namespace {

// A part about the origin of the tree.
struct Body {
  double share = 0.0;  // of the volume
  Vec3 center;
  std::array<double, 6> covariance{};
};

std::array<double, 6> squares(const Vec3& v) {
  return {v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
}

// Of the ellipsoid that has this covariance.
double ellipsoid_volume(const std::array<double, 6>& c) {
  const double determinant = c[0] * (c[3] * c[5] - c[4] * c[4]) -
                             c[1] * (c[1] * c[5] - c[4] * c[2]) +
                             c[2] * (c[1] * c[4] - c[3] * c[2]);
  return 4.0 / 3.0 * std::numbers::pi * std::sqrt(125.0 * std::max(0.0, determinant));
}

Body kept_body(const SignaturePart& part, double size) {
  Body body{part.weight, size * part.center, part.covariance};
  for (double& c : body.covariance) c *= size * size;
  return body;
}

Body body_of_points(const Sketch& sketch, int part, const Vec3& origin) {
  Body body;
  double count = 0.0;
  for (std::size_t i = 0; i < sketch.points.size(); ++i) {
    if (sketch.parts[i] != part) continue;
    const Vec3 p = sketch.points[i] - origin;
    body.center = body.center + p;
    const auto square = squares(p);
    for (std::size_t k = 0; k < 6; ++k) body.covariance[k] += square[k];
    count += 1.0;
  }
  if (count == 0.0) return body;
  body.share = count;
  body.center = (1.0 / count) * body.center;
  const auto square = squares(body.center);
  for (std::size_t k = 0; k < 6; ++k) body.covariance[k] = body.covariance[k] / count - square[k];
  return body;
}

// Parts that the signature left out share what volume is left by their points.
std::vector<Body> bodies_of(const ShapeData& data) {
  const Signature& signature = data.signature;
  std::vector<Body> bodies;
  double left = 1.0;
  double points = 0.0;
  for (int part = 0; part < data.sketch.part_count; ++part) {
    const auto i = static_cast<std::size_t>(part);
    const bool kept = i < signature.parts.size();
    bodies.push_back(kept ? kept_body(signature.parts[i], signature.size)
                          : body_of_points(data.sketch, part, signature.centroid));
    (kept ? left : points) += kept ? -bodies.back().share : bodies.back().share;
  }
  for (std::size_t i = signature.parts.size(); i < bodies.size(); ++i) {
    bodies[i].share *= points > 0.0 ? std::max(0.0, left) / points : 0.0;
  }
  return bodies;
}

Moments moments_of(const Body& body, double volume) {
  Moments moments;
  moments.volume = volume * body.share;
  moments.first = moments.volume * body.center;
  const auto square = squares(body.center);
  for (std::size_t k = 0; k < 6; ++k) {
    moments.second[k] = moments.volume * (body.covariance[k] + square[k]);
  }
  return moments;
}

void count_points(const ShapeData& data, MergeTree& tree) {
  std::vector<std::size_t> counts(tree.moments.size(), 0);
  for (const int part : data.sketch.parts) {
    tree.piece_of_point.push_back(part < 0 ? kNoBasin : static_cast<std::uint32_t>(part));
    if (part >= 0) ++counts[static_cast<std::size_t>(part)];
  }
  const auto drawn = static_cast<double>(std::max<std::size_t>(1, data.sketch.parts.size()));
  for (const std::size_t count : counts) {
    const double share = static_cast<double>(count) / drawn;
    tree.point_count.push_back(
        static_cast<std::uint32_t>(std::llround(share * static_cast<double>(data.points))));
  }
}

void add_necks(const Signature& signature, MergeTree& tree) {
  for (std::uint32_t a = 0; a < signature.parts.size(); ++a) {
    for (const PartNeighbor& neighbor : signature.parts[a].neighbors) {
      const auto b = static_cast<std::uint32_t>(neighbor.part);
      if (a < b && b < tree.moments.size()) {
        tree.necks.push_back({a, b, signature.size * neighbor.neck_radius});
      }
    }
  }
}

}  // namespace

MergeTree tree_of(const ShapeData& data) {
  const std::vector<Body> bodies = bodies_of(data);
  double volume = 0.0;
  for (const Body& body : bodies) volume += ellipsoid_volume(body.covariance);
  MergeTree tree;
  tree.origin = data.signature.centroid;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool kept = i < data.signature.parts.size();
    tree.moments.push_back(moments_of(bodies[i], volume));
    tree.ball_center.push_back(tree.origin + bodies[i].center);
    tree.ball_radius.push_back(kept ? data.signature.size * data.signature.parts[i].ball_radius
                                    : 0.0);
  }
  count_points(data, tree);
  add_necks(data.signature, tree);
  tree.merges = data.sketch.merges;
  tree.component_count = bodies.size() - tree.merges.size();
  tree.natural_ratio = 1.0;
  return tree;
}

}  // namespace morsel::serve
