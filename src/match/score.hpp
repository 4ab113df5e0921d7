// The two terms of the default score.
#pragma once

#include <cstdint>
#include <morsel/signature.hpp>
#include <span>

namespace morsel {

/// Weighted L1 distance of two signatures' tables: a metric, 0 for equal ones.
[[nodiscard]] double table_distance(std::span<const std::uint8_t> a,
                                    std::span<const std::uint8_t> b);

/// The score of a distance: 1 at 0, falling towards 0.
[[nodiscard]] double score_of_distance(double distance);

}  // namespace morsel
