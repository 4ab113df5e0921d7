#include "picture/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace morsel::picture {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kMargin = 0.035F;  // around each object, of the picture's width

struct Extent {
  Vector2f low = Vector2f::Constant(std::numeric_limits<float>::infinity());
  Vector2f high = Vector2f::Constant(-std::numeric_limits<float>::infinity());

  [[nodiscard]] Vector2f size() const { return high - low; }
};

// The object's bounding rectangle in a view. Points far from all others do not count, so that a
// few outliers do not shrink the object.
Extent extent_of(const std::vector<Surfel>& surfels, const Matrix3f& rotation) {
  Extent extent;
  for (const Surfel& surfel : surfels) {
    if (surfel.isolated) continue;
    const Vector3f center = rotation * surfel.position;
    const float radius = surfel.ball ? surfel.major.norm() : 0.4F * surfel.minor.norm();
    extent.low = extent.low.cwiseMin((center.head<2>().array() - radius).matrix());
    extent.high = extent.high.cwiseMax((center.head<2>().array() + radius).matrix());
  }
  if (!(extent.low.x() <= extent.high.x())) return {Vector2f(-1, -0.5F), Vector2f(1, 0.5F)};
  // A point, or a line seen from its end, still needs a size.
  const Vector2f growth = (Vector2f::Constant(0.02F) - 0.5F * extent.size()).cwiseMax(0.0F);
  return {extent.low - growth, extent.high + growth};
}

struct Arrangement {
  std::size_t columns = 1;
  float scale = 0.0F;
};

// The height of each row and the sum of the widths in the widest, in units.
struct Rows {
  std::vector<float> heights;
  float widest = 0.0F;
};

Rows rows_of(const std::vector<Extent>& extents, std::size_t columns) {
  Rows rows;
  for (std::size_t first = 0; first < extents.size(); first += columns) {
    float height = 0.0F;
    float width = 0.0F;
    for (std::size_t i = first; i < std::min(first + columns, extents.size()); ++i) {
      height = std::max(height, extents[i].size().y());
      width += extents[i].size().x();
    }
    rows.heights.push_back(height);
    rows.widest = std::max(rows.widest, width);
  }
  return rows;
}

Arrangement largest_arrangement(const std::vector<Extent>& extents, float width) {
  Arrangement best;
  for (const std::size_t row_count : {std::size_t{1}, std::size_t{2}}) {
    if (row_count > 1 && extents.size() < 3) break;
    const std::size_t columns = (extents.size() + row_count - 1) / row_count;
    const Rows rows = rows_of(extents, columns);
    const float wide = width * (1.0F - kMargin * static_cast<float>(columns + 1)) / rows.widest;
    const float tall = width * (1.0F - kMargin * static_cast<float>(row_count + 1)) /
                       std::accumulate(rows.heights.begin(), rows.heights.end(), 0.0F);
    const float scale = std::min(wide, tall);
    if (scale > best.scale) best = {columns, scale};
  }
  return best;
}

}  // namespace

Layout arrange(const std::vector<Surfel>& surfels, const std::vector<Matrix3f>& views,
               std::size_t width, std::size_t top) {
  std::vector<Extent> extents;
  for (const Matrix3f& view : views) extents.push_back(extent_of(surfels, view));
  const auto picture_width = static_cast<float>(width);
  const Arrangement best = largest_arrangement(extents, picture_width);
  const Rows rows = rows_of(extents, best.columns);
  const float margin = kMargin * picture_width;

  Layout layout;
  layout.scale = best.scale;
  layout.object_size = 0.0F;
  // Neighbouring cells share the margin between them.
  float y = static_cast<float>(top) + 0.5F * margin;
  for (std::size_t first = 0; first < views.size(); first += best.columns) {
    const std::size_t last = std::min(first + best.columns, views.size());
    const float height = best.scale * rows.heights[first / best.columns] + margin;
    float used = 0.0F;
    for (std::size_t i = first; i < last; ++i) used += best.scale * extents[i].size().x() + margin;
    const float spare = (picture_width - margin - used) / static_cast<float>(last - first);
    float x = 0.5F * margin;
    for (std::size_t i = first; i < last; ++i) {
      const float cell_width = best.scale * extents[i].size().x() + margin + spare;
      Cell cell{views[i], 0.5F * (extents[i].low + extents[i].high)};
      cell.left = static_cast<std::size_t>(std::max(0.0F, x));
      cell.top = static_cast<std::size_t>(y);
      cell.width =
          std::min(static_cast<std::size_t>(std::max(1.0F, cell_width)), width - cell.left);
      cell.height = static_cast<std::size_t>(std::ceil(height));
      layout.cells.push_back(cell);
      layout.object_size = std::max(layout.object_size, best.scale * extents[i].size().maxCoeff());
      x += cell_width;
    }
    y += height;
  }
  layout.height = static_cast<std::size_t>(std::ceil(y + 0.5F * margin)) + 1;
  return layout;
}

}  // namespace morsel::picture
