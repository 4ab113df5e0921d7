// Which merges divide parts, and in which order they are undone.
#pragma once

#include <cstdint>
#include <morsel/segment.hpp>
#include <vector>

namespace morsel {

/// Says of each merge whether both sides hold enough of their object's points to be parts. `merges`
/// are in their order; `point_count` (p). Cost: O(p).
void mark_significant(const std::vector<std::uint32_t>& point_count, std::vector<Merge>& merges);

/// Gives the merges new ratios, ascending again, so that each cut undoes those that are worth most
/// together: a dear merge that divides much comes first, a cheap one that divides much last, and
/// what is cheap itself but hides something dear below it is undone with that. Cheap and dear are
/// told apart by `natural_ratio`, which leaves as many parts as before where nothing is hidden.
/// `merges` ascend and are marked; `point_count` (p). Cost: O(p²) at worst.
/// Source: the nested prunings of L. Breiman, J. Friedman, R. Olshen, C. Stone, "Classification and
/// Regression Trees", 1984, section 3.3 (weakest link), over the tree of merges.
void rank_merges(const std::vector<std::uint32_t>& point_count, double natural_ratio,
                 std::vector<Merge>& merges);

}  // namespace morsel
