#include "sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <morsel/error.hpp>
#include <utility>

#include "base/box.hpp"
#include "base/point_tree.hpp"
#include "base/random.hpp"

namespace morsel::bench {
namespace {

// Sets the outliers apart from the samples, which stay the same for every share of outliers.
constexpr std::uint64_t kOutlierStream = 0x6f75746c696572ULL;
// Places the hole, the same for every level of noise and size of the hole.
constexpr std::uint64_t kHoleStream = 0x686f6c65ULL;

// Grown by half of itself about its middle.
Box grown_box(std::span<const Vec3> points) {
  const Box box = bounding_box(points);
  const Vec3 margin = 0.25 * (box.high - box.low);
  return {.low = box.low - margin, .high = box.high + margin};
}

// A scan's gap: the samples in a ball around one of them are missing.
void cut_hole(SurfaceSample& sample, const TriangleMesh& mesh, double radius, std::uint64_t seed) {
  Random random(seed ^ kHoleStream);
  const auto count = static_cast<double>(sample.points.size());
  const Vec3 center = sample.points[static_cast<std::size_t>(random.uniform() * count)];
  const double reach = radius * bounding_box(mesh.vertices).diagonal();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    if (distance(sample.points[i], center) < reach) continue;
    sample.points[kept] = sample.points[i];
    sample.triangle[kept++] = sample.triangle[i];
  }
  sample.points.resize(kept);
  sample.triangle.resize(kept);
}

Vec3 centroid(const TriangleMesh& mesh, std::size_t face) {
  const auto& [a, b, c] = mesh.triangles[face];
  return (1.0 / 3.0) * (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]);
}

}  // namespace

void CloudOptions::check() const {
  SampleOptions{.count = points, .noise = noise, .seed = seed}.check();
  if (!(outliers >= 0.0 && outliers <= 1.0)) {
    throw Error(ErrorCode::kUsage,
                fmt::format("CloudOptions.outliers is {}; expected 0 to 1", outliers));
  }
  if (!(hole >= 0.0 && hole < 1.0)) {
    throw Error(ErrorCode::kUsage,
                fmt::format("CloudOptions.hole is {}; expected 0 to below 1", hole));
  }
}

std::uint64_t seed_of_model(std::uint64_t seed, int id) {
  return Random(seed ^ (static_cast<std::uint64_t>(id) * 0x9e3779b97f4a7c15ULL)).next();
}

std::vector<Vec3> outliers_around(std::span<const Vec3> points, std::size_t count,
                                  std::uint64_t seed) {
  const auto [low, high] = grown_box(points);
  const Vec3 size = high - low;
  Random random(seed ^ kOutlierStream);
  std::vector<Vec3> outliers;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = low.x + random.uniform() * size.x;
    const double y = low.y + random.uniform() * size.y;
    const double z = low.z + random.uniform() * size.z;
    outliers.push_back({x, y, z});
  }
  return outliers;
}

Cloud sample_cloud(const TriangleMesh& mesh, int id, const CloudOptions& options) {
  options.check();
  const std::uint64_t seed = seed_of_model(options.seed, id);
  SurfaceSample sample =
      sample_surface(mesh, {.count = options.points, .noise = options.noise, .seed = seed});
  if (options.hole > 0.0) cut_hole(sample, mesh, options.hole, seed);
  Cloud cloud{.points = std::move(sample.points), .triangle = std::move(sample.triangle)};
  const double count = std::round(options.outliers * static_cast<double>(options.points));
  const std::vector<Vec3> outliers =
      outliers_around(mesh.vertices, static_cast<std::size_t>(count), seed);
  cloud.points.insert(cloud.points.end(), outliers.begin(), outliers.end());
  return cloud;
}

std::vector<Vec3> carried_over(const Cloud& cloud, const TriangleMesh& from,
                               const TriangleMesh& to) {
  std::vector<Vec3> points;
  points.reserve(cloud.sample_count());
  for (std::size_t i = 0; i < cloud.sample_count(); ++i) {
    const auto& [a, b, c] = from.triangles[cloud.triangle[i]];
    const Vec3 u = from.vertices[b] - from.vertices[a];
    const Vec3 v = from.vertices[c] - from.vertices[a];
    const Vec3 p = cloud.points[i] - from.vertices[a];
    const Vec3 normal = cross(u, v);
    const double along_u = dot(cross(p, v), normal) / squared_norm(normal);
    const double along_v = dot(cross(u, p), normal) / squared_norm(normal);
    points.push_back(to.vertices[a] + along_u * (to.vertices[b] - to.vertices[a]) +
                     along_v * (to.vertices[c] - to.vertices[a]));
  }
  return points;
}

std::vector<int> face_labels(const TriangleMesh& mesh, const Cloud& cloud,
                             std::span<const int> labels) {
  std::vector<std::pair<std::uint32_t, int>> votes;
  votes.reserve(cloud.sample_count());
  for (std::size_t i = 0; i < cloud.sample_count(); ++i) {
    votes.emplace_back(cloud.triangle[i], labels[i]);
  }
  std::sort(votes.begin(), votes.end());

  std::vector<int> result(mesh.triangles.size(), 0);
  std::vector<std::size_t> most(mesh.triangles.size(), 0);
  for (std::size_t begin = 0; begin < votes.size();) {
    std::size_t end = begin;
    while (end < votes.size() && votes[end] == votes[begin]) ++end;
    const auto& [face, label] = votes[begin];
    if (end - begin > most[face]) {
      most[face] = end - begin;
      result[face] = label;
    }
    begin = end;
  }

  const PointTree tree(std::span(cloud.points).first(cloud.sample_count()));
  for (std::size_t face = 0; face < result.size(); ++face) {
    if (most[face] == 0) result[face] = labels[tree.nearest(centroid(mesh, face)).index];
  }
  return result;
}

}  // namespace morsel::bench
