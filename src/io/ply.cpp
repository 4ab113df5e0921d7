// PLY: a text header that declares elements and their properties, then rows as text or as binary
// of either byte order. Only the element `vertex` and the lists of the element `face` are kept;
// everything else is walked over.
// Source: G. Turk, "The PLY Polygon File Format", 1994.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/bytes.hpp"
#include "io/geometry.hpp"
#include "io/scanner.hpp"

namespace morsel::io {
namespace {

struct Property {
  std::string name;
  ScalarType type = ScalarType::kFloat32;
  std::optional<ScalarType> count_type;  // of a list property
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
};

std::optional<ScalarType> scalar_type(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, ScalarType>, 16> kNames = {{
      {"char", ScalarType::kInt8},
      {"int8", ScalarType::kInt8},
      {"uchar", ScalarType::kUint8},
      {"uint8", ScalarType::kUint8},
      {"short", ScalarType::kInt16},
      {"int16", ScalarType::kInt16},
      {"ushort", ScalarType::kUint16},
      {"uint16", ScalarType::kUint16},
      {"int", ScalarType::kInt32},
      {"int32", ScalarType::kInt32},
      {"uint", ScalarType::kUint32},
      {"uint32", ScalarType::kUint32},
      {"float", ScalarType::kFloat32},
      {"float32", ScalarType::kFloat32},
      {"double", ScalarType::kFloat64},
      {"float64", ScalarType::kFloat64},
  }};
  for (const auto& [known, type] : kNames) {
    if (known == name) return type;
  }
  return std::nullopt;
}

// ---- header ----

ScalarType parse_type(const LineScanner& scanner, std::string_view& rest) {
  const std::string_view name = next_token(rest);
  const std::optional<ScalarType> type = scalar_type(name);
  if (!type) {
    scanner.fail("unknown type " + in_quotes(name) +
                 "; expected one of char, uchar, short, ushort, int, uint, float, double");
  }
  return *type;
}

Encoding parse_encoding(const LineScanner& scanner, std::string_view rest) {
  const std::string_view name = next_token(rest);
  if (next_token(rest) == "1.0") {
    if (name == "ascii") return Encoding::kAscii;
    if (name == "binary_little_endian") return Encoding::kLittleEndian;
    if (name == "binary_big_endian") return Encoding::kBigEndian;
  }
  scanner.fail(
      "unknown format; expected 'format ascii 1.0', 'format binary_little_endian 1.0' or "
      "'format binary_big_endian 1.0'");
}

Property parse_property(const LineScanner& scanner, std::string_view rest) {
  Property property;
  std::string_view after_list = rest;
  if (next_token(after_list) == "list") {
    property.count_type = parse_type(scanner, after_list);
    if (is_float(*property.count_type)) {
      scanner.fail("the length of a list is declared as a float; expected an integer type");
    }
    rest = after_list;
  }
  property.type = parse_type(scanner, rest);
  property.name = next_token(rest);
  if (property.name.empty()) scanner.fail("the property has no name");
  return property;
}

Element parse_element(const LineScanner& scanner, std::string_view rest) {
  Element element;
  element.name = next_token(rest);
  element.count =
      scanner.integer<std::uint64_t>(rest, "the count of element " + in_quotes(element.name));
  return element;
}

Header parse_header(LineScanner& scanner) {
  Header header;
  bool has_encoding = false;
  if (!scanner.next() || trimmed(scanner.line()) != "ply") {
    scanner.fail("expected the line 'ply'; found " + in_quotes(scanner.line()));
  }
  while (true) {
    if (!scanner.next()) scanner.fail("the file ends within the header; expected 'end_header'");
    std::string_view rest = scanner.line();
    const std::string_view keyword = next_token(rest);
    if (keyword == "end_header") break;
    if (keyword == "format") {
      header.encoding = parse_encoding(scanner, rest);
      has_encoding = true;
    } else if (keyword == "element") {
      header.elements.push_back(parse_element(scanner, rest));
    } else if (keyword == "property") {
      if (header.elements.empty()) scanner.fail("a property before the first 'element' line");
      header.elements.back().properties.push_back(parse_property(scanner, rest));
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      scanner.fail("unknown header line " + in_quotes(scanner.line()) +
                   "; expected format, element, property, comment or end_header");
    }
  }
  if (!has_encoding) scanner.fail("the header has no 'format' line before 'end_header'");
  return header;
}

void check_header(const Source& source, const Header& header) {
  std::size_t vertex_elements = 0;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") ++vertex_elements;
    if (element.count > 0 && element.properties.empty()) {
      fail(source.name, fmt::format("the header promises {} of element {} without any property",
                                    element.count, in_quotes(element.name)));
    }
  }
  if (vertex_elements != 1) {
    fail(source.name,
         fmt::format("the header has {} elements named vertex; expected one", vertex_elements));
  }
}

// ---- rows ----

// Rows of text, one a line.
class TextRows {
 public:
  explicit TextRows(LineScanner& scanner) : scanner_(scanner) {}

  [[nodiscard]] std::size_t remaining() const { return scanner_.remaining(); }
  // The least that a value takes: a digit and what separates it from the next.
  [[nodiscard]] std::size_t min_bytes(ScalarType) const { return 2; }

  void begin_row(const Element& element, std::size_t row) {
    scanner_.require_line('\0', fmt::format("{} {} of {}", element.name, row, element.count));
    rest_ = scanner_.line();
  }
  double value(const Property& property, ScalarType type) {
    return scanner_.scalar(rest_, type, property.name);
  }
  void check_list(std::size_t length, const Property&) const {
    check_count(scanner_.place(), length, 2, rest_.size(), "list entries");
  }
  void skip_list(std::size_t length, const Property& property) {
    for (std::size_t i = 0; i < length; ++i) value(property, property.type);
  }
  void end_row(const Element& element) {
    const std::string_view extra = next_token(rest_);
    if (extra.empty()) return;
    fail(fmt::format("a value too many, {}; element {} declares {} properties", in_quotes(extra),
                     element.name, element.properties.size()));
  }
  [[noreturn]] void fail(const std::string& message) const { scanner_.fail(message); }

 private:
  LineScanner& scanner_;
  std::string_view rest_;
};

// Rows of binary, packed.
class BinaryRows {
 public:
  explicit BinaryRows(ByteReader& reader) : reader_(reader) {}

  [[nodiscard]] std::size_t remaining() const { return reader_.remaining(); }
  [[nodiscard]] std::size_t min_bytes(ScalarType type) const { return size_of(type); }

  void begin_row(const Element&, std::size_t) {}
  double value(const Property& property, ScalarType type) {
    return reader_.read(type, property.name);
  }
  void check_list(std::size_t length, const Property& property) const {
    if (length <= reader_.remaining() / size_of(property.type)) return;
    fail(
        fmt::format("{} has {} entries, but only {} bytes are left; the file is truncated or "
                    "damaged",
                    property.name, length, reader_.remaining()));
  }
  void skip_list(std::size_t length, const Property& property) {
    reader_.take(length * size_of(property.type), property.name);
  }
  void end_row(const Element&) {}
  [[noreturn]] void fail(const std::string& message) const { reader_.fail(message); }

 private:
  ByteReader& reader_;
};

template <class Rows>
std::size_t list_length(Rows& rows, const Property& property) {
  const double length = rows.value(property, *property.count_type);
  if (length < 0)
    rows.fail(fmt::format("{} has {} entries; expected 0 or more", property.name, length));
  const auto count = static_cast<std::size_t>(length);
  rows.check_list(count, property);
  return count;
}

template <class Rows>
void skip_property(Rows& rows, const Property& property) {
  if (property.count_type) {
    rows.skip_list(list_length(rows, property), property);
  } else {
    rows.value(property, property.type);
  }
}

template <class Rows>
void skip_element(Rows& rows, const Element& element) {
  for (std::size_t row = 0; row < element.count; ++row) {
    rows.begin_row(element, row);
    for (const Property& property : element.properties) skip_property(rows, property);
    rows.end_row(element);
  }
}

template <class Rows>
PointCloud read_vertices(Rows& rows, const Element& element, const std::string& name) {
  std::vector<Column> columns;
  for (const Property& property : element.properties) {
    if (!property.count_type) columns.push_back({property.name, property.type});
  }
  PointTable table(name, columns, element.count);
  for (std::size_t row = 0; row < element.count; ++row) {
    rows.begin_row(element, row);
    std::size_t column = 0;
    for (const Property& property : element.properties) {
      if (property.count_type) {
        skip_property(rows, property);
        continue;
      }
      const double value = rows.value(property, property.type);
      if (table.is_coordinate(column) && !std::isfinite(value)) {
        fail_at_point(name, row,
                      fmt::format("{} is {}; expected a finite number, so remove "
                                  "invalid points first",
                                  property.name, value));
      }
      table.set(column++, value);
    }
    rows.end_row(element);
    table.end_row();
  }
  return table.take();
}

template <class Rows>
void read_corners(Rows& rows, const Property& property, std::size_t face, std::size_t vertices,
                  std::vector<std::uint32_t>& corners) {
  const std::size_t length = list_length(rows, property);
  corners.clear();
  for (std::size_t i = 0; i < length; ++i) {
    const double index = rows.value(property, property.type);
    if (!(index >= 0 && index < static_cast<double>(vertices)) || index != std::floor(index)) {
      rows.fail(fmt::format("face {} has the vertex index {}; expected 0 to {}", face, index,
                            static_cast<double>(vertices) - 1));
    }
    corners.push_back(static_cast<std::uint32_t>(index));
  }
}

template <class Rows>
std::vector<Triangle> read_faces(Rows& rows, const Element& element, std::size_t vertices) {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> corners;
  for (std::size_t row = 0; row < element.count; ++row) {
    rows.begin_row(element, row);
    for (const Property& property : element.properties) {
      if (property.count_type &&
          (property.name == "vertex_indices" || property.name == "vertex_index")) {
        read_corners(rows, property, row, vertices, corners);
        append_fan(corners, triangles);
      } else {
        skip_property(rows, property);
      }
    }
    rows.end_row(element);
  }
  return triangles;
}

template <class Rows>
void check_element(const Rows& rows, const Element& element, const std::string& name) {
  std::size_t row_bytes = 0;
  for (const Property& property : element.properties) {
    row_bytes += rows.min_bytes(property.count_type.value_or(property.type));
  }
  if (element.count > 0) {
    check_count(name, element.count, row_bytes, rows.remaining(), element.name + " rows");
  }
}

template <class Rows>
Geometry read_elements(Rows rows, const Header& header, const std::string& name) {
  const std::size_t vertices =
      std::find_if(header.elements.begin(), header.elements.end(), [](const Element& element) {
        return element.name == "vertex";
      })->count;
  Geometry geometry;
  for (const Element& element : header.elements) {
    check_element(rows, element, name);
    if (element.name == "vertex") {
      geometry.cloud = read_vertices(rows, element, name);
    } else if (element.name == "face") {
      geometry.triangles = read_faces(rows, element, vertices);
    } else {
      skip_element(rows, element);
    }
  }
  return geometry;
}

}  // namespace

Geometry read_ply(const Source& source) {
  const std::string_view bytes = source.bytes;
  const bool old_mac = bytes.size() > 4 && bytes[3] == '\r' && bytes[4] != '\n';
  LineScanner scanner(source, old_mac ? '\r' : '\n');
  const Header header = parse_header(scanner);
  check_header(source, header);
  if (header.encoding == Encoding::kAscii) {
    return read_elements(TextRows(scanner), header, source.name);
  }
  ByteReader reader(
      source, scanner.offset(),
      header.encoding == Encoding::kLittleEndian ? std::endian::little : std::endian::big);
  return read_elements(BinaryRows(reader), header, source.name);
}

}  // namespace morsel::io
