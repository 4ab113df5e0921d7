// morsel: what is kept of a segmented shape so that it can be shown without its points.
#pragma once

#include <cstddef>
#include <morsel/morsel.hpp>
#include <morsel/segment.hpp>
#include <morsel/vec3.hpp>
#include <string>
#include <vector>

namespace morsel {

/// A few points of each part and the merge tree above the cut. Everything in it is rounded as
/// encode_sketch() stores it, so that it does not change when it is written and read.
struct Sketch {
  Vec3 origin;                ///< of the grid that the points lie on, in the unit of the input
  double step = 0.0;          ///< of the grid: 1/255 of the longest extent
  std::vector<Vec3> points;   ///< (k, 3), at most 2000, in the unit of the input, grouped by part
  std::vector<int> parts;     ///< (k) part of each point; -1 where there is no inside
  std::vector<Merge> merges;  ///< of the parts, ascending in ratio: where coarser cuts join them
  int part_count = 0;
};

/// Thins the points out evenly and keeps the merges above the cut.
/// The same for any order of the input points. Cost: O(n).
[[nodiscard]] Sketch make_sketch(const Segmentation& segmentation);

/// Compact bytes, about one and a half a point: versioned, little-endian, deflated.
[[nodiscard]] std::string encode_sketch(const Sketch& sketch);

/// Throws Error(kInput) that names `name` and what is wrong with the bytes: also where they are of
/// more points than make_sketch() keeps.
[[nodiscard]] Sketch decode_sketch(std::string bytes, const std::string& name);

/// Draws the sketch from three quarters, `width` pixels wide, as the bytes of a PNG file.
[[nodiscard]] std::string draw_thumbnail(const Sketch& sketch, std::size_t width = 128);

}  // namespace morsel
