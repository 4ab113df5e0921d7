// Option values read strictly: all of the text is one number in range, or a message says why not.
#pragma once

#include <cstdint>
#include <string>

namespace morsel::cli {

/// Allowed values of a fractional option.
struct Range {
  double low = 0.0;
  double high = 0.0;
  bool low_allowed = true;  ///< whether `low` itself is
};

/// Whole decimal number from `low` to `high`.
/// Throws CLI::ValidationError that names `option`, `text` and the range.
[[nodiscard]] std::uint64_t whole_number(const std::string& option, const std::string& text,
                                         std::uint64_t low, std::uint64_t high);

/// Finite decimal number within `range`. Throws as whole_number.
[[nodiscard]] double number(const std::string& option, const std::string& text, const Range& range);

}  // namespace morsel::cli
