#include "picture/scene.hpp"

#include <algorithm>
#include <morsel/error.hpp>
#include <string>

#include "picture/views.hpp"

namespace morsel::picture {
namespace {

// Points closer than this many pixels are merged: more detail than the picture can show.
constexpr float kMergePixels = 1.3F;
// Keeps the grid within the 21 bits a coordinate of its codes.
constexpr float kFinestCell = 2e-6F;
constexpr std::size_t kMostSamples = 48'000'000;  // of one view

std::vector<Eigen::Vector3f> positions(const std::vector<Surfel>& surfels) {
  std::vector<Eigen::Vector3f> result;
  for (const Surfel& surfel : surfels) {
    if (!surfel.isolated) result.push_back(surfel.position);
  }
  return result;
}

std::vector<Eigen::Matrix3f> views_of(const Scene& scene, const PictureOptions& options) {
  if (options.pose_of.empty()) return choose_views(positions(scene.surfels), options.views);
  const std::vector<int> labels(options.pose_of.size(), 0);
  return choose_views(normalize(options.pose_of, labels).points, options.views);
}

}  // namespace

Scene make_scene(std::span<const Vec3> points, std::span<const int> labels,
                 const PictureOptions& options) {
  options.check();
  if (points.size() != labels.size()) {
    throw Error(ErrorCode::kUsage, "picture: " + std::to_string(labels.size()) + " labels for " +
                                       std::to_string(points.size()) +
                                       " points; give one label a point");
  }
  const auto width = static_cast<float>(options.width);
  Scene scene;
  std::size_t title_rows = 0;
  if (!options.title.empty()) {
    scene.title_size = std::clamp(width / 38.0F, 10.0F, 48.0F);
    scene.title_baseline = 1.7F * scene.title_size;
    title_rows = static_cast<std::size_t>(2.0F * scene.title_size);
  }
  // The object is 2 units long and spans no more than its column.
  const float columns = options.views > 1 ? 2.0F : 1.0F;
  const float cell = std::max(kFinestCell, kMergePixels * 2.0F * columns / width);
  scene.surfels = make_surfels(merge_on_grid(normalize(points, labels), cell));
  scene.layout = arrange(scene.surfels, views_of(scene, options), options.width, title_rows);
  return scene;
}

std::size_t supersampling(const Cell& cell) {
  return 4 * cell.width * cell.height <= kMostSamples ? 2 : 1;
}

Surface render_cell(const Scene& scene, const Cell& cell, std::size_t factor) {
  const auto samples = static_cast<float>(factor);
  Camera camera;
  camera.rotation = cell.rotation;
  camera.scale = samples * scene.layout.scale;
  camera.width = factor * cell.width;
  camera.height = factor * cell.height;
  camera.offset_x = 0.5F * static_cast<float>(camera.width) - camera.scale * cell.center.x();
  camera.offset_y = 0.5F * static_cast<float>(camera.height) + camera.scale * cell.center.y();
  return rasterize(scene.surfels, camera, 0.6F * samples);
}

Style style_of(const Scene& scene, std::size_t factor) {
  const auto samples = static_cast<float>(factor);
  const float line = std::clamp(scene.layout.object_size / 300.0F, 0.7F, 2.5F) * samples;
  return {samples * scene.layout.object_size, line, 0.45F * line};
}

}  // namespace morsel::picture
