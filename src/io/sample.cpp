// Random points on the surface of a mesh.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <morsel/error.hpp>
#include <morsel/io.hpp>
#include <vector>

#include "base/box.hpp"
#include "base/noise.hpp"
#include "base/random.hpp"
#include "base/unit_scale.hpp"

namespace morsel {
namespace {

constexpr std::size_t kMaxCount = std::size_t{1} << 31;
// Sets the noise apart from the choice of the points, which stay the same for every noise.
constexpr std::uint64_t kNoiseStream = 0x6e6f697365ULL;

void check_mesh(const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v < mesh.vertices.size()) continue;
      throw Error(ErrorCode::kInput,
                  fmt::format("triangle {} has the vertex index {}; the mesh has "
                              "{} vertices",
                              t, v, mesh.vertices.size()));
    }
  }
}

// Of the vertices that a triangle uses.
Box bounding_box(const TriangleMesh& mesh) {
  Box box;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) box.add(mesh.vertices[v]);
  }
  return box;
}

// Element i is the area of triangles 0 to i, of the mesh at about unit size.
std::vector<double> cumulative_areas(const TriangleMesh& mesh, double size) {
  const double scale = unit_scale(size);
  std::vector<double> sums;
  sums.reserve(mesh.triangles.size());
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 u = scale * (mesh.vertices[b] - mesh.vertices[a]);
    const Vec3 v = scale * (mesh.vertices[c] - mesh.vertices[a]);
    sum += 0.5 * norm(cross(u, v));
    sums.push_back(sum);
  }
  return sums;
}

// Uniform on the triangle: a point of the parallelogram of two edges, whose farther half is turned
// back onto the triangle.
Vec3 point_on(const Vec3& a, const Vec3& b, const Vec3& c, Random& random) {
  double s = random.uniform();
  double t = random.uniform();
  if (s + t > 1.0) {
    s = 1.0 - s;
    t = 1.0 - t;
  }
  return a + s * (b - a) + t * (c - a);
}

}  // namespace

void SampleOptions::check() const {
  if (count < 1 || count > kMaxCount) {
    throw Error(ErrorCode::kUsage,
                fmt::format("SampleOptions.count is {}; expected 1 to {}", count, kMaxCount));
  }
  if (!(noise >= 0.0 && noise <= 1.0)) {
    throw Error(ErrorCode::kUsage,
                fmt::format("SampleOptions.noise is {}; expected 0 to 1", noise));
  }
}

SurfaceSample sample_surface(const TriangleMesh& mesh, const SampleOptions& options) {
  options.check();
  check_mesh(mesh);
  const Box box = bounding_box(mesh);
  const std::vector<double> areas = cumulative_areas(mesh, box.longest_side());
  const double total = areas.empty() ? 0.0 : areas.back();
  if (!(total > 0.0) || !std::isfinite(total)) {
    throw Error(ErrorCode::kInput,
                "the mesh has no area to sample; expected triangles with three different corners");
  }
  Random random(options.seed);
  Random noise(options.seed ^ kNoiseStream);
  const double sigma = options.noise * box.diagonal();
  SurfaceSample sample;
  sample.points.reserve(options.count);
  sample.triangle.reserve(options.count);
  for (std::size_t i = 0; i < options.count; ++i) {
    const auto chosen = std::upper_bound(areas.begin(), areas.end(), random.uniform() * total);
    const auto t = std::min(static_cast<std::size_t>(chosen - areas.begin()), areas.size() - 1);
    const auto& [a, b, c] = mesh.triangles[t];
    sample.points.push_back(point_on(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], random));
    sample.triangle.push_back(static_cast<std::uint32_t>(t));
  }
  if (sigma > 0.0) add_noise(sample.points, sigma, noise);
  return sample;
}

double signed_volume(const TriangleMesh& mesh) {
  check_mesh(mesh);
  if (mesh.triangles.empty()) return 0.0;
  // About a vertex of the mesh, so that a mesh far from the origin loses no precision.
  const Vec3 origin = mesh.vertices[mesh.triangles[0][0]];
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum +=
        dot(mesh.vertices[a] - origin, cross(mesh.vertices[b] - origin, mesh.vertices[c] - origin));
  }
  return sum / 6.0;
}

}  // namespace morsel
