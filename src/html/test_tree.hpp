// A merge tree without geometry, for the tests of the page and of the viewer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <morsel/segment.hpp>
#include <vector>

#include "base/random.hpp"

namespace morsel::shapes {

/// `pieces` pieces in three objects over `points` points, with ties among ratios and volumes and
/// with merges that count for nothing.
inline MergeTree random_tree(std::uint32_t pieces, std::size_t points, std::uint64_t seed = 3) {
  constexpr std::uint32_t kObjects = 3;
  Random random(seed);
  const auto below = [&](std::uint64_t bound) {
    return static_cast<std::uint32_t>(random.below(bound));
  };
  MergeTree tree;
  tree.component_count = kObjects;
  tree.origin = {1.0, -2.0, 0.5};
  tree.natural_ratio = 1.4;
  tree.point_count.assign(pieces, 0);
  for (std::size_t i = 0; i < points; ++i) {
    tree.piece_of_point.push_back(below(pieces));
    ++tree.point_count[tree.piece_of_point.back()];
  }
  for (std::uint32_t p = 0; p < pieces; ++p) {
    const double volume = 0.25 * static_cast<double>(1 + below(8));
    const Vec3 mean{random.normal(), random.normal(), random.normal()};
    tree.moments.push_back({volume,
                            volume * mean,
                            {volume * (mean.x * mean.x + 1.0), volume * mean.x * mean.y, 0.0,
                             volume * (mean.y * mean.y + 0.5), 0.0, volume * 2.0}});
    tree.ball_center.push_back(mean);
    tree.ball_radius.push_back(random.uniform());
    if (p < kObjects) continue;
    // A piece joins an earlier one of its object.
    const std::uint32_t other = p % kObjects + kObjects * below(p / kObjects);
    const double ratio = 1.0 + 0.125 * static_cast<double>(below(40));
    tree.merges.push_back({ratio, other, p, below(3) > 0});
    tree.necks.push_back({other, p, random.uniform()});
  }
  std::ranges::stable_sort(tree.merges, {}, &Merge::ratio);
  return tree;
}

}  // namespace morsel::shapes
