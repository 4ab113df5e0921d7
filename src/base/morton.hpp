// The bits of Morton codes.
#pragma once

#include <cstdint>

namespace morsel {

/// Spreads the lowest 21 bits of x so that two zero bits follow each.
[[nodiscard]] constexpr std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffULL;
  x = (x | x << 16) & 0x1f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

}  // namespace morsel
