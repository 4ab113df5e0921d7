// morsel: the colours of the parts.
#pragma once

#include <array>
#include <cstdint>

namespace morsel {

/// An sRGB colour, 0 … 255 a channel.
using Color = std::array<std::uint8_t, 3>;

/// The colour of part `part` >= 0; colours of small indices differ for colour-blind people too.
/// A negative part is grey. The first 240 all differ, beyond 24 less clearly. Thread-safe, O(1).
/// Source: M. Okabe, K. Ito, "Color Universal Design", 2008 (the first seven colours).
[[nodiscard]] Color part_color(int part) noexcept;

}  // namespace morsel
