// Lines and tokens of text files: the one scanner that all text formats share.
#pragma once

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

#include "io/bytes.hpp"
#include "io/source.hpp"

namespace morsel::io {

enum class NumberResult { kOk, kNotANumber, kOutOfRange };

/// Parses all of `token` (a sign, digits, exponent, nan, inf), whatever the locale. Numbers too
/// small for a double become 0.
[[nodiscard]] NumberResult parse_double(std::string_view token, double& value);

/// Parses all of `token` as a decimal integer that fits T.
template <class T>
[[nodiscard]] bool parse_integer(std::string_view token, T& value) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  return error == std::errc{} && stop == end;
}

[[nodiscard]] constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Cuts the next token off the front of `rest`; tokens are separated by blanks. Empty at the end.
[[nodiscard]] std::string_view next_token(std::string_view& rest);
[[nodiscard]] std::size_t count_tokens(std::string_view line);

[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);

/// Walks the lines of a source. A line ends with LF, CR LF, or (in files without LF) CR.
class LineScanner {
 public:
  explicit LineScanner(const Source& source);
  /// With a given line end, for text headers of binary files.
  LineScanner(const Source& source, char line_end) : source_(source), line_end_(line_end) {}

  /// Moves to the next line; false after the last. `line()` is then without its line end.
  bool next();
  /// Moves to the next line that is not blank and does not begin with `comment`; text after
  /// `comment` within the line is cut off. False after the last.
  bool next_content(char comment);
  /// As `next_content`, but throws when the file ends; `expected` as in "vertex 7 of 8".
  void require_line(char comment, const std::string& expected);

  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::size_t line_number() const { return line_number_; }
  /// The byte after the current line and its end.
  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] std::size_t remaining() const { return source_.bytes.size() - offset_; }
  /// "FILE:LINE", for check_count.
  [[nodiscard]] std::string place() const;

  [[noreturn]] void fail(const std::string& message) const;

  /// The next token of `rest` as a finite number; `what` names it in errors.
  double finite(std::string_view& rest, std::string_view what) const;
  /// As `finite`, but lets nan and inf pass.
  double number(std::string_view& rest, std::string_view what) const;
  /// As `number`, and an integer within its range where `type` is one.
  double scalar(std::string_view& rest, ScalarType type, std::string_view what) const;
  template <class T>
  T integer(std::string_view& rest, std::string_view what) const {
    const std::string_view token = next_token(rest);
    T value{};
    if (!parse_integer(token, value)) fail_integer(token, what);
    return value;
  }
  /// Checks a number already cut out as a token.
  double number_of(std::string_view token, std::string_view what) const;
  double finite_of(std::string_view token, std::string_view what) const;

 private:
  [[noreturn]] void fail_integer(std::string_view token, std::string_view what) const;
  [[noreturn]] void fail_token(std::string_view token, std::string_view what,
                               const std::string& wanted) const;

  const Source& source_;
  char line_end_;
  std::string_view line_;
  std::size_t line_number_ = 0;
  std::size_t offset_ = 0;
};

}  // namespace morsel::io
