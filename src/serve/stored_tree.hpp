// The merge tree of a shape of which only a sketch and a signature are kept.
#pragma once

#include <morsel/database.hpp>
#include <morsel/segment.hpp>

namespace morsel::serve {

/// Its pieces are the parts of the sketch, its points the sketch's points. Shares of the volume,
/// centres, covariances, largest balls and necks are the signature's for the parts that it keeps;
/// for the others they are reckoned from the sketch's points, without a ball. The volume as a whole
/// is not kept: it is that of the parts' ellipsoids. `point_count` is scaled to all points.
[[nodiscard]] MergeTree tree_of(const ShapeData& data);

}  // namespace morsel::serve
