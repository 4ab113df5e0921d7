// What the page knows of the shape.
#pragma once

#include <cstddef>
#include <morsel/html.hpp>
#include <morsel/segment.hpp>
#include <morsel/vec3.hpp>
#include <span>
#include <string>

namespace morsel {

/// The shape as JSON that may stand in a <script> element: no '<' in it, whatever the name. Arrays
/// are objects of `type` ("u8", "i8", "u16", "u32", "f64") and `data`, base64 of little-endian
/// values. web/src/shape/format.ts reads it and says what each field means.
[[nodiscard]] std::string shape_json(std::span<const Vec3> points, const MergeTree& tree,
                                     const HtmlOptions& options);

/// Points in the colours of their parts, without a tree: center, scale, view, palette and points as
/// in shape_json, whose pieces are the parts, `part_count` where a point has none (-1).
[[nodiscard]] std::string picture_json(std::span<const Vec3> points, std::span<const int> parts,
                                       std::size_t part_count);

}  // namespace morsel
