#include "io/scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string>

namespace morsel::io {

namespace {

// Whether a number out of the range of a double is below it: a negative exponent, or no exponent
// and no digit but 0 before the decimal point.
bool is_tiny(std::string_view token) {
  const std::size_t exponent = token.find_first_of("eE");
  if (exponent != std::string_view::npos) return token.substr(exponent + 1).starts_with('-');
  return token.substr(0, token.find('.')).find_first_not_of("-0") == std::string_view::npos;
}

}  // namespace

NumberResult parse_double(std::string_view token, double& value) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) return NumberResult::kNotANumber;
  if (error != std::errc::result_out_of_range) return NumberResult::kOk;
  // from_chars does not tell too large from too small.
  if (!is_tiny(token)) return NumberResult::kOutOfRange;
  value = 0.0;
  return NumberResult::kOk;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view next_token(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  const std::string_view token = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return token;
}

std::size_t count_tokens(std::string_view line) {
  std::size_t count = 0;
  while (!next_token(line).empty()) ++count;
  return count;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

LineScanner::LineScanner(const Source& source)
    : LineScanner(source, source.bytes.find('\n') == std::string::npos ? '\r' : '\n') {
  constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";
  if (source.bytes.starts_with(kUtf8Mark)) offset_ = kUtf8Mark.size();
}

bool LineScanner::next() {
  const std::string& bytes = source_.bytes;
  if (offset_ >= bytes.size()) return false;
  const char* begin = bytes.data() + offset_;
  const std::size_t left = bytes.size() - offset_;
  const void* found = std::memchr(begin, line_end_, left);
  const std::size_t length =
      found != nullptr ? static_cast<std::size_t>(static_cast<const char*>(found) - begin) : left;
  line_ = std::string_view(begin, length);
  if (line_end_ == '\n' && line_.ends_with('\r')) line_.remove_suffix(1);
  offset_ += std::min(length + 1, left);
  ++line_number_;
  return true;
}

bool LineScanner::next_content(char comment) {
  while (next()) {
    if (comment != '\0') line_ = line_.substr(0, line_.find(comment));
    line_ = trimmed(line_);
    if (!line_.empty()) return true;
  }
  return false;
}

void LineScanner::require_line(char comment, const std::string& expected) {
  if (!next_content(comment)) fail("the file ends here; expected " + expected);
}

std::string LineScanner::place() const { return fmt::format("{}:{}", source_.name, line_number_); }

void LineScanner::fail(const std::string& message) const {
  fail_at_line(source_.name, line_number_, message);
}

void LineScanner::fail_token(std::string_view token, std::string_view what,
                             const std::string& wanted) const {
  if (token.empty()) fail(fmt::format("{} is missing; expected {}", what, wanted));
  const bool binary = std::any_of(token.begin(), token.end(), is_control);
  fail(fmt::format("{} is {}; expected {}{}", what, in_quotes(token), wanted,
                   binary ? " (binary data in a text file?)" : ""));
}

void LineScanner::fail_integer(std::string_view token, std::string_view what) const {
  fail_token(token, what, "an integer in range");
}

double LineScanner::number_of(std::string_view token, std::string_view what) const {
  double value = 0.0;
  switch (parse_double(token, value)) {
    case NumberResult::kOk:
      return value;
    case NumberResult::kOutOfRange:
      fail_token(token, what, "a number within the range of a double");
    case NumberResult::kNotANumber:
      break;
  }
  fail_token(token, what, "a number");
}

double LineScanner::finite_of(std::string_view token, std::string_view what) const {
  const double value = number_of(token, what);
  if (!std::isfinite(value)) fail_token(token, what, "a finite number");
  return value;
}

double LineScanner::number(std::string_view& rest, std::string_view what) const {
  return number_of(next_token(rest), what);
}

double LineScanner::scalar(std::string_view& rest, ScalarType type, std::string_view what) const {
  const std::string_view token = next_token(rest);
  const double value = number_of(token, what);
  if (is_float(type)) return value;
  const double span = std::ldexp(1.0, static_cast<int>(8 * size_of(type)));
  const double low = is_signed(type) ? -span / 2 : 0.0;
  if (value != std::floor(value) || value < low || value >= low + span) {
    fail_token(token, what, fmt::format("an integer from {} to {}", low, low + span - 1));
  }
  return value;
}

double LineScanner::finite(std::string_view& rest, std::string_view what) const {
  return finite_of(next_token(rest), what);
}

}  // namespace morsel::io
