#include "numbers.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace morsel::cli {
namespace {

// True when all of `text` is one number; from_chars takes neither spaces nor the user's locale.
template <class Number>
bool parse(const std::string& text, Number& value) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stop == end;
}

[[noreturn]] void reject(const std::string& option, const std::string& text,
                         const std::string& expected) {
  throw CLI::ValidationError(option, fmt::format("'{}' is not {}", text, expected));
}

}  // namespace

std::uint64_t whole_number(const std::string& option, const std::string& text, std::uint64_t low,
                           std::uint64_t high) {
  std::uint64_t value = 0;
  if (parse(text, value) && value >= low && value <= high) return value;
  const bool bounded = high != std::numeric_limits<std::uint64_t>::max();
  reject(option, text,
         bounded ? fmt::format("a whole number from {} to {}", low, high)
                 : fmt::format("a whole number of at least {}", low));
}

double number(const std::string& option, const std::string& text, const Range& range) {
  double value = 0.0;
  const bool parsed = parse(text, value) && std::isfinite(value);
  if (parsed && (value > range.low || (range.low_allowed && value == range.low)) &&
      value <= range.high) {
    return value;
  }
  const std::string low =
      fmt::format("{} {}", range.low_allowed ? "of at least" : "above", range.low);
  reject(option, text,
         std::isfinite(range.high) ? fmt::format("a number {} and at most {}", low, range.high)
                                   : fmt::format("a number {}", low));
}

}  // namespace morsel::cli
