// What the default score is made of, one measure at a time.

#include <cstddef>
#include <morsel/match.hpp>

#include "match/score.hpp"

namespace morsel {

std::vector<ScoreTerm> explain_score(const Signature& a, const Signature& b, MatchMode mode) {
  if (!(a.size > 0.0) || !(b.size > 0.0)) return {};
  const auto tables_a = tables_of(a);
  const auto tables_b = tables_of(b);
  const BlockSums sums = block_sums(tables_a.data(), tables_b.data());
  std::vector<ScoreTerm> terms;
  for (std::size_t k = 0; k < kTableBlocks.size(); ++k) {
    // A weight is what a distance of one in this measure alone adds.
    BlockSums alone{};
    alone[k] = static_cast<std::uint32_t>(kTableBlocks[k].unit);
    terms.push_back({kTableBlocks[k].name, static_cast<double>(sums[k]) / kTableBlocks[k].unit,
                     table_distance(alone, tables_a[0], tables_b[0], mode)});
  }
  return terms;
}

}  // namespace morsel
