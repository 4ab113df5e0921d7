// What every reader returns, and how it is collected.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <morsel/io.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes.hpp"
#include "io/source.hpp"

namespace morsel::io {

using Triangle = std::array<std::uint32_t, 3>;

/// Points, and the triangles over them where the file has faces.
struct Geometry {
  PointCloud cloud;
  std::vector<Triangle> triangles;
};

/// Appends the polygon as a fan about its first corner; fewer than three corners add nothing.
void append_fan(std::span<const std::uint32_t> polygon, std::vector<Triangle>& triangles);

/// Throws, naming the first point, unless all coordinates are finite.
void require_finite(const std::string& name, const std::vector<Vec3>& points);

/// One scalar column of a table of points.
struct Column {
  std::string name;
  ScalarType type = ScalarType::kFloat32;
};

/// Turns a table of points, filled column by column value, into a PointCloud: the columns x, y and
/// z become the coordinates, the others properties.
class PointTable {
 public:
  /// Throws Error(kInput) at `place` when x, y or z is missing or a name is there twice.
  PointTable(const std::string& place, const std::vector<Column>& columns, std::size_t rows);

  [[nodiscard]] bool is_coordinate(std::size_t column) const { return target_[column] < 3; }
  /// Sets the value of `column` for the next point; every column once, then `end_row`.
  void set(std::size_t column, double value);
  void end_row() { cloud_.points.push_back(point_); }
  [[nodiscard]] PointCloud take() { return std::move(cloud_); }

 private:
  static constexpr std::size_t kDropped = SIZE_MAX;

  // Per column: 0, 1, 2 for a coordinate, 3 + i for property i, or kDropped.
  std::vector<std::size_t> target_;
  Vec3 point_;
  PointCloud cloud_;
};

// The readers, one a format. All throw Error(kInput).
[[nodiscard]] Geometry read_text(const Source& source);
[[nodiscard]] Geometry read_ply(const Source& source);
[[nodiscard]] Geometry read_pcd(const Source& source);
[[nodiscard]] Geometry read_npy(const Source& source);
[[nodiscard]] Geometry read_las(const Source& source);
[[nodiscard]] Geometry read_off(const Source& source);
[[nodiscard]] Geometry read_obj(const Source& source);
[[nodiscard]] Geometry read_stl(const Source& source);
[[nodiscard]] Geometry read_gltf(const Source& source);

}  // namespace morsel::io
