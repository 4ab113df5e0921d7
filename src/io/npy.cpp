// NPY: one NumPy array of shape (n, 3).
// Source: NumPy, "NEP 1: A simple file format for NumPy arrays", versions 1.0 to 3.0.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/bytes.hpp"
#include "io/geometry.hpp"
#include "io/scanner.hpp"

namespace morsel::io {
namespace {

struct Array {
  ScalarType type = ScalarType::kFloat64;
  std::endian order = std::endian::little;
  bool columns_first = false;  // Fortran order
  std::size_t rows = 0;
};

// Where NumPy's header dictionary is and what stands there, for messages.
struct Dictionary {
  const std::string& name;
  std::size_t byte;
  std::string_view text;

  [[noreturn]] void fail(const std::string& message) const { fail_at_byte(name, byte, message); }

  // The text after "'key':", without leading blanks.
  [[nodiscard]] std::string_view value(std::string_view key) const {
    for (const char quote : {'\'', '"'}) {
      const std::string pattern = quote + std::string(key) + quote;
      const std::size_t at = text.find(pattern);
      if (at == std::string_view::npos) continue;
      std::string_view rest = trimmed(text.substr(at + pattern.size()));
      if (rest.starts_with(':')) return trimmed(rest.substr(1));
    }
    fail(fmt::format("the header {} has no {}; expected descr, fortran_order and shape",
                     in_quotes(text), in_quotes(key)));
  }
};

ScalarType parse_type(const Dictionary& dictionary, std::string_view code) {
  constexpr std::array<std::pair<std::string_view, ScalarType>, 10> kCodes = {{
      {"i1", ScalarType::kInt8},
      {"u1", ScalarType::kUint8},
      {"i2", ScalarType::kInt16},
      {"u2", ScalarType::kUint16},
      {"i4", ScalarType::kInt32},
      {"u4", ScalarType::kUint32},
      {"i8", ScalarType::kInt64},
      {"u8", ScalarType::kUint64},
      {"f4", ScalarType::kFloat32},
      {"f8", ScalarType::kFloat64},
  }};
  for (const auto& [known, type] : kCodes) {
    if (known == code) return type;
  }
  dictionary.fail("the array is of type " + in_quotes(code) +
                  "; expected floats of 4 or 8 bytes (f4, f8) or integers (i1 … u8)");
}

// "'<f8'": byte order, kind and size.
void parse_descr(const Dictionary& dictionary, Array& array) {
  const std::string_view value = dictionary.value("descr");
  if (value.empty() || (value[0] != '\'' && value[0] != '"')) {
    dictionary.fail("the array is structured, " + in_quotes(value) +
                    "; expected a plain array of numbers of shape (n, 3)");
  }
  std::string_view code = value.substr(1, value.find(value[0], 1) - 1);
  if (!code.empty() && (code[0] == '<' || code[0] == '>' || code[0] == '|' || code[0] == '=')) {
    array.order = code[0] == '>' ? std::endian::big : std::endian::little;
    code.remove_prefix(1);
  }
  array.type = parse_type(dictionary, code);
}

void parse_shape(const Dictionary& dictionary, Array& array) {
  const std::string_view value = dictionary.value("shape");
  const std::string_view shape = value.substr(0, value.find(')'));
  const std::size_t comma = shape.find(',');
  std::string_view columns = comma == std::string_view::npos ? "" : shape.substr(comma + 1);
  columns = trimmed(columns.substr(0, columns.find(',')));
  if (!shape.starts_with('(') || columns != "3" ||
      !parse_integer(trimmed(shape.substr(1, comma - 1)), array.rows)) {
    dictionary.fail("the array has shape " + in_quotes(std::string(shape) + ")") +
                    "; expected (n, 3), so save points[:, :3]");
  }
}

Array parse_header(const Source& source, ByteReader& reader) {
  reader.take(6, "the magic bytes");
  const auto major = reader.read<std::uint8_t>("the version");
  reader.read<std::uint8_t>("the version");
  if (major < 1 || major > 3) {
    fail_at_byte(source.name, 6, fmt::format("NPY version {}; expected 1, 2 or 3", major));
  }
  const std::size_t length = major == 1 ? reader.read<std::uint16_t>("the header length")
                                        : reader.read<std::uint32_t>("the header length");
  const std::size_t at = reader.offset();
  const std::string_view text(reader.take(length, "the header"), length);
  const Dictionary dictionary{source.name, at, text};
  Array array;
  parse_descr(dictionary, array);
  parse_shape(dictionary, array);
  const std::string_view order = dictionary.value("fortran_order");
  array.columns_first = order.starts_with("True");
  if (!array.columns_first && !order.starts_with("False")) {
    dictionary.fail("fortran_order is " + in_quotes(order) + "; expected True or False");
  }
  return array;
}

}  // namespace

Geometry read_npy(const Source& source) {
  ByteReader reader(source, 0);
  const Array array = parse_header(source, reader);
  const std::size_t scalar = size_of(array.type);
  check_count(source.name, array.rows, 3 * scalar, reader.remaining(), "points");
  const char* data = reader.take(3 * scalar * array.rows, "the points");
  const std::size_t row_step = array.columns_first ? scalar : 3 * scalar;
  const std::size_t column_step = array.columns_first ? scalar * array.rows : scalar;
  Geometry geometry;
  geometry.cloud.points.reserve(array.rows);
  for (std::size_t row = 0; row < array.rows; ++row) {
    const auto at = [&](std::size_t column) {
      return load_scalar(data + row * row_step + column * column_step, array.type, array.order);
    };
    geometry.cloud.points.push_back({at(0), at(1), at(2)});
  }
  require_finite(source.name, geometry.cloud.points);
  return geometry;
}

}  // namespace morsel::io
