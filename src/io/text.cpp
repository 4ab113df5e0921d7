// XYZ, TXT, PTS, CSV: one point a line, three numbers among its columns.
//
// Separators are blanks, tabs, one comma or one semicolon. A header line that names x, y and z says
// in which columns they are; otherwise they are the first three. A line with a single integer, as
// PTS files have it, announces how many points follow.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/geometry.hpp"
#include "io/scanner.hpp"

namespace morsel::io {
namespace {

constexpr char kAnySeparator = '\0';

bool is_comment(std::string_view line) {
  return line.starts_with('#') || line.starts_with('%') || line.starts_with("//");
}

bool is_separator(char c) { return c == ',' || c == ';'; }

// Cuts the next field off `rest`; nothing at the end of the line. Between two separators the field
// is empty. Quotes are taken off, and may hold separators.
std::optional<std::string_view> next_field(std::string_view& rest, char separator) {
  const auto ends_field = [separator](char c) {
    return separator == kAnySeparator ? is_blank(c) || is_separator(c) : c == separator;
  };
  const auto skip_blanks = [&] {
    while (!rest.empty() && is_blank(rest[0]) && rest[0] != separator) rest.remove_prefix(1);
  };
  skip_blanks();
  if (rest.empty()) return std::nullopt;
  std::string_view field;
  if (rest[0] == '"' || rest[0] == '\'') {
    const std::size_t close = rest.find(rest[0], 1);
    const std::size_t length = std::min(close, rest.size()) - 1;
    field = rest.substr(1, length);
    rest.remove_prefix(std::min(length + 2, rest.size()));
  } else {
    std::size_t end = 0;
    while (end < rest.size() && !ends_field(rest[end])) ++end;
    field = rest.substr(0, end);
    rest.remove_prefix(end);
  }
  skip_blanks();
  if (!rest.empty() &&
      (rest[0] == separator || (separator == kAnySeparator && is_separator(rest[0])))) {
    rest.remove_prefix(1);
  }
  return trimmed(field);
}

std::vector<std::string_view> all_fields(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  while (const auto field = next_field(line, separator)) fields.push_back(*field);
  return fields;
}

bool is_number(std::string_view field) {
  double ignored = 0.0;
  return parse_double(field, ignored) != NumberResult::kNotANumber;
}

// "1,5 2,25 3,0" or "1,5;2,25;3,0": numbers as some countries write them, which would otherwise be
// taken for twice as many columns.
bool has_decimal_commas(std::string_view line) {
  std::string blanked(line);
  std::replace(blanked.begin(), blanked.end(), ';', ' ');
  std::string_view rest = blanked;
  for (int i = 0; i < 3; ++i) {
    const std::string_view token = next_token(rest);
    const std::size_t comma = token.find(',');
    if (comma == std::string_view::npos || !is_number(token.substr(0, comma)) ||
        !is_number(token.substr(comma + 1))) {
      return false;
    }
  }
  return true;
}

// The axis, 0 to 2, that a column's name stands for: x, "X [m]", pos_x, coord_x, "Points:0", …
std::optional<std::size_t> axis_of(std::string_view name) {
  std::string plain;
  for (const char c : name.substr(0, name.find_first_of("[("))) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0) plain += static_cast<char>(std::tolower(byte));
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char letter = static_cast<char>('x' + axis);
    for (const std::string_view prefix :
         {"", "p", "pos", "position", "coord", "coordinate", "coordinates", "point", "points"}) {
      if (plain == std::string(prefix) + letter) return axis;
    }
    for (const std::string_view suffix : {"pos", "position", "coord", "coordinate"}) {
      if (plain == letter + std::string(suffix)) return axis;
    }
    if (plain == "points" + std::to_string(axis)) return axis;
  }
  return std::nullopt;
}

class TextReader {
 public:
  explicit TextReader(const Source& source) : scanner_(source) {}

  PointCloud read() {
    while (scanner_.next()) {
      const std::string_view line = trimmed(scanner_.line());
      if (line.empty() || is_comment(line)) continue;
      if (!begins_block(line) && !is_header(line)) read_point(line);
    }
    if (block_ && cloud_.points.size() < block_->end) fail_block("the file ends after");
    return std::move(cloud_);
  }

 private:
  // Points announced by a line with nothing but their number.
  struct Block {
    std::size_t line = 0;
    std::size_t count = 0;
    std::size_t end = 0;  // points of the file up to the end of this block
  };

  [[nodiscard]] bool at_begin() const { return cloud_.points.empty() && !has_header_; }

  bool begins_block(std::string_view line) {
    const bool expected = block_ ? cloud_.points.size() == block_->end : at_begin();
    std::size_t count = 0;
    if (!expected || !parse_integer(line, count)) return false;
    check_count(scanner_.place(), count, 6, scanner_.remaining(), "points");
    block_ = {scanner_.line_number(), count, cloud_.points.size() + count};
    return true;
  }

  // A first line without any number holds the columns' names.
  bool is_header(std::string_view line) {
    if (!at_begin()) return false;
    char separator = kAnySeparator;
    for (const char candidate : {'\t', ',', ';'}) {
      if (line.find(candidate) != std::string_view::npos) separator = candidate;
    }
    const std::vector<std::string_view> names = all_fields(line, separator);
    if (std::any_of(names.begin(), names.end(), is_number) || has_decimal_commas(line)) {
      return false;
    }
    if (std::any_of(line.begin(), line.end(), is_control)) {
      scanner_.fail("binary data in a text file; expected 'x y z' on each line");
    }
    use_names(names);
    separator_ = separator;
    has_header_ = true;
    return true;
  }

  void use_names(const std::vector<std::string_view>& names) {
    std::array<std::optional<std::size_t>, 3> column_of;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::optional<std::size_t> axis = axis_of(names[i]);
      if (axis && !column_of[*axis]) column_of[*axis] = i;
    }
    const auto found = std::count_if(column_of.begin(), column_of.end(),
                                     [](const auto& column) { return column.has_value(); });
    if (found == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!column_of[axis]) {
        scanner_.fail(fmt::format("the header {} names no column {}; expected x, y and z",
                                  in_quotes(scanner_.line()), "xyz"[axis]));
      }
    }
    const std::size_t last = **std::max_element(column_of.begin(), column_of.end());
    axis_of_column_.assign(last + 1, kIgnored);
    for (std::size_t axis = 0; axis < 3; ++axis) axis_of_column_[*column_of[axis]] = axis;
  }

  void read_point(std::string_view line) {
    if (cloud_.points.empty()) check_first_point(line);
    if (block_ && cloud_.points.size() == block_->end) fail_block("there are more than");
    std::array<double, 3> coordinates = {};
    for (const std::size_t axis : axis_of_column_) {
      const std::string_view field = next_field(line, separator_).value_or("");
      if (axis != kIgnored) coordinates[axis] = scanner_.finite_of(field, kNames[axis]);
    }
    cloud_.points.push_back({coordinates[0], coordinates[1], coordinates[2]});
  }

  void check_first_point(std::string_view line) {
    if (has_decimal_commas(line)) {
      scanner_.fail("numbers with decimal commas, " + in_quotes(line) +
                    "; expected decimal points, as in 1.5");
    }
    if (line.find(separator_) == std::string_view::npos) separator_ = kAnySeparator;
  }

  [[noreturn]] void fail_block(const char* what) const {
    scanner_.fail(fmt::format("line {} promises {} points, but {} {}", block_->line, block_->count,
                              what, cloud_.points.size() - (block_->end - block_->count)));
  }

  static constexpr std::size_t kIgnored = SIZE_MAX;
  static constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};

  LineScanner scanner_;
  PointCloud cloud_;
  bool has_header_ = false;
  char separator_ = kAnySeparator;
  std::vector<std::size_t> axis_of_column_ = {0, 1, 2};
  std::optional<Block> block_;
};

}  // namespace

Geometry read_text(const Source& source) { return {TextReader(source).read(), {}}; }

}  // namespace morsel::io
