// The default score: a weighted L1 distance of the tables.
#pragma once

#include <array>
#include <cstdint>
#include <morsel/match.hpp>
#include <morsel/signature.hpp>

#include "signature/tables.hpp"

namespace morsel {

/// L1 distance of each block, or a lower bound of it.
using BlockSums = std::array<std::uint32_t, kTableBlocks.size()>;

/// `a` and `b` hold kTableSize values.
[[nodiscard]] BlockSums block_sums(const std::uint8_t* a, const std::uint8_t* b);

/// The mean of the blocks' distances, each in units of two unrelated shapes, by the weights of the
/// mode; tables of the inside count by the product of both solidities. Never falls when a sum
/// rises, rounding included: a lower bound of the sums gives a lower bound of the distance.
[[nodiscard]] inline double table_distance(const BlockSums& sums, std::uint8_t solidity_a,
                                           std::uint8_t solidity_b, MatchMode mode) {
  const double inside = static_cast<double>(solidity_a * solidity_b) / (255.0 * 255.0);
  double total = 0.0;
  double weights = 0.0;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const TableBlock& block = kTableBlocks[k];
    double weight = block.source == TableSource::kInside ? inside : 1.0;
    if (mode == MatchMode::kArticulated) weight *= block.articulated;
    total += weight * (static_cast<double>(sums[k]) / block.unit);
    weights += weight;
  }
  return total / weights;
}

/// As options.check(), and throws Error(kUsage) in partial mode.
void check_for_signatures(const MatchOptions& options);

/// The tables of a signature, zeros where it has none.
[[nodiscard]] std::array<std::uint8_t, kTableSize> tables_of(const Signature& signature);

/// 1 at 0, falling towards 0; about 0.37 for unrelated shapes.
[[nodiscard]] double score_of_distance(double distance);

/// How much of the score is left when mirror images are told apart: the best overlap of the parts
/// without mirroring over the best with it. Symmetric; 1 for equal signatures.
[[nodiscard]] double same_handedness(const Signature& a, const Signature& b);

}  // namespace morsel
