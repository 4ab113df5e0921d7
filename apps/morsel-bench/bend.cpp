#include "bend.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "base/shortest_ways.hpp"

namespace morsel::bench {
namespace {

Graph edges_of(const TriangleMesh& mesh) {
  Graph graph(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i];
      const std::uint32_t b = triangle[(i + 1) % 3];
      graph[a].emplace_back(b, distance(mesh.vertices[a], mesh.vertices[b]));
      graph[b].emplace_back(a, distance(mesh.vertices[a], mesh.vertices[b]));
    }
  }
  return graph;
}

// Ways along the edges from one vertex; those that are not reached are not of interest: 0.
std::vector<double> ways_from(const Graph& graph, std::uint32_t from) {
  std::vector<double> ways = shortest_ways(graph, from);
  std::ranges::replace(ways, std::numeric_limits<double>::infinity(), 0.0);
  return ways;
}

std::uint32_t largest(const std::vector<double>& values) {
  return static_cast<std::uint32_t>(std::ranges::max_element(values) - values.begin());
}

// What is bent in one go: vertices are turned by the share `weight` of the angle.
struct Limb {
  std::vector<double> weight;  // (v) 0 … 1
  Vec3 joint;
  Vec3 direction;  // of the limb from the joint
};

// The limb that ends `length` along the surface from the vertex that `way` begins at. Its weights
// are empty if that is no limb.
Limb find_limb(const std::vector<Vec3>& vertices, const std::vector<double>& way, double length) {
  constexpr double kRing = 0.15;        // half the width of the ring, as a share of the length
  constexpr double kThin = 0.35;        // radius of the ring, likewise, at most
  constexpr double kLargest = 1.0 / 3;  // share of the vertices that a limb has at most
  Limb limb;
  std::vector<std::size_t> ring;
  Vec3 middle;
  Vec3 body;
  std::size_t inside = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (std::abs(way[v] - length) < kRing * length) {
      ring.push_back(v);
      middle = middle + vertices[v];
    }
    if (way[v] < length) {
      ++inside;
      body = body + vertices[v];
    }
  }
  if (ring.size() < 6 || static_cast<double>(inside) > kLargest * static_cast<double>(way.size())) {
    return limb;
  }
  limb.joint = (1.0 / static_cast<double>(ring.size())) * middle;
  for (const std::size_t v : ring) {
    if (distance(vertices[v], limb.joint) > kThin * length) return limb;
  }
  limb.direction = (1.0 / static_cast<double>(inside)) * body - limb.joint;
  const double blend = kThin * length;
  for (const double w : way) {
    const double t = std::clamp((length + blend - w) / (2.0 * blend), 0.0, 1.0);
    limb.weight.push_back(t * t * (3.0 - 2.0 * t));
  }
  return limb;
}

// Rodrigues' rotation about an axis through the origin.
Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
         ((1.0 - std::cos(angle)) * dot(axis, v)) * axis;
}

void bend(const Limb& limb, Random& random, std::vector<Vec3>& vertices) {
  const Vec3 any{random.normal(), random.normal(), random.normal()};
  const Vec3 across = cross(limb.direction, any);
  if (!(norm(across) > 0.0)) return;
  const Vec3 axis = (1.0 / norm(across)) * across;
  const double angle = (30.0 + 30.0 * random.uniform()) * std::numbers::pi / 180.0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (limb.weight[v] == 0.0) continue;
    vertices[v] = limb.joint + turned(vertices[v] - limb.joint, axis, limb.weight[v] * angle);
  }
}

}  // namespace

Bent bend_limbs(const TriangleMesh& mesh, std::uint64_t seed) {
  constexpr std::size_t kExtremities = 10;
  const Graph graph = edges_of(mesh);
  Random random(seed);
  Bent bent{mesh, 0};
  // The farthest vertex from any is an extremity, then again the farthest from all found.
  std::uint32_t extremity = largest(ways_from(graph, 0));
  std::vector<double> nearest(graph.size(), std::numeric_limits<double>::infinity());
  double reach = 0.0;
  std::vector<double> taken(mesh.vertices.size(), 0.0);  // by the limbs found
  for (std::size_t k = 0; k < kExtremities; ++k) {
    const std::vector<double> way = ways_from(graph, extremity);
    for (std::size_t v = 0; v < way.size(); ++v) nearest[v] = std::min(nearest[v], way[v]);
    extremity = largest(nearest);
    reach = std::max(reach, *std::ranges::max_element(way));
    for (const double share : {0.35, 0.28, 0.22, 0.17, 0.13}) {
      const Limb limb = find_limb(mesh.vertices, way, share * reach);
      if (limb.weight.empty()) continue;
      bool free = true;
      for (std::size_t v = 0; v < way.size(); ++v) free &= limb.weight[v] * taken[v] == 0.0;
      if (!free) continue;
      for (std::size_t v = 0; v < way.size(); ++v) taken[v] += limb.weight[v];
      bend(limb, random, bent.mesh.vertices);
      ++bent.limbs;
      break;
    }
  }
  return bent;
}

}  // namespace morsel::bench
