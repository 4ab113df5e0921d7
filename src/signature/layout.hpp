// Where encode() puts what the search reads without decoding.
#pragma once

#include <cstddef>

namespace morsel {

/// Byte at which the length stands, a 16-bit number.
inline constexpr std::size_t kLengthAt = 6;
/// Byte at which the size of the shape stands, as a 64-bit floating-point number.
inline constexpr std::size_t kSizeAt = 36;
/// Byte at which the tables begin, after magic, version, length, counts, centroid and size.
inline constexpr std::size_t kTablesAt = 44;

}  // namespace morsel
