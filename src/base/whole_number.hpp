#pragma once

#include <cstdint>
#include <limits>
#include <optional>

namespace morsel {

/// The number, if it is whole and from 0 to the type's largest: JSON's own conversion cuts
/// fractions off and is undefined for what is too large.
template <typename Integer, typename Json>
std::optional<Integer> whole_number(const Json& json) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<Integer>::max());
  if (!json.is_number_unsigned()) return std::nullopt;
  const auto number = json.template get<std::uint64_t>();
  return number <= kMost ? std::optional(static_cast<Integer>(number)) : std::nullopt;
}

}  // namespace morsel
