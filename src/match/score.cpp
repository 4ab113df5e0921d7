#include "match/score.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "match/align.hpp"

namespace morsel {

BlockSums block_sums(const std::uint8_t* a, const std::uint8_t* b) {
  BlockSums sums{};
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const TableBlock& block = kTableBlocks[k];
    std::uint32_t sum = 0;
    for (std::size_t i = block.offset; i < block.offset + block.size; ++i) {
      sum += static_cast<std::uint32_t>(std::abs(a[i] - b[i]));
    }
    sums[k] = sum;
  }
  return sums;
}

std::array<std::uint8_t, kTableSize> tables_of(const Signature& signature) {
  std::array<std::uint8_t, kTableSize> tables{};
  std::copy_n(signature.tables.begin(), std::min(signature.tables.size(), kTableSize),
              tables.begin());
  return tables;
}

double score_of_distance(double distance) { return std::exp(-distance); }

double same_handedness(const Signature& a, const Signature& b) {
  if (a.parts == b.parts) return 1.0;
  // In one order for both, so that exchanging them changes no bit.
  const bool swap = encode(b) < encode(a);
  const std::vector<Blob> target = blobs_of(swap ? b : a);
  const std::vector<Blob> source = blobs_of(swap ? a : b);
  const double proper = align(target, source, false).overlap;
  const double any = align(target, source, true).overlap;
  return any > 0.0 ? std::min(1.0, proper / any) : 1.0;
}

}  // namespace morsel
