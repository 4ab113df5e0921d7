// PCD, the format of the Point Cloud Library: a text header, then rows as text, as packed binary,
// or as LZF-compressed binary that is stored field by field.
// Source: Point Cloud Library, "The PCD (Point Cloud Data) file format", version 0.7.
#include <fmt/format.h>
#include <liblzf/lzf.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/bytes.hpp"
#include "io/geometry.hpp"
#include "io/scanner.hpp"

namespace morsel::io {
namespace {

struct Field {
  std::string name;
  ScalarType type = ScalarType::kFloat32;
  std::size_t count = 1;  // scalars a point

  [[nodiscard]] std::size_t bytes() const { return count * size_of(type); }
};

enum class Data { kAscii, kBinary, kCompressed };

struct Header {
  std::vector<Field> fields;
  std::size_t points = 0;
  std::size_t row_bytes = 0;
  Data data = Data::kAscii;
};

// The header lines as they stand; checked and joined into a Header once DATA is reached.
struct RawHeader {
  std::vector<std::string> names;
  std::vector<std::size_t> sizes;
  std::vector<std::string> types;
  std::vector<std::size_t> counts;
  std::optional<std::size_t> width;
  std::optional<std::size_t> height;
  std::optional<std::size_t> points;
};

std::vector<std::string> words(std::string_view rest) {
  std::vector<std::string> result;
  while (true) {
    const std::string_view token = next_token(rest);
    if (token.empty()) return result;
    result.emplace_back(token);
  }
}

std::vector<std::size_t> integers(const LineScanner& scanner, std::string_view rest,
                                  std::string_view what) {
  std::vector<std::size_t> result;
  while (!trimmed(rest).empty()) result.push_back(scanner.integer<std::uint64_t>(rest, what));
  return result;
}

std::optional<ScalarType> scalar_type(const std::string& kind, std::size_t size) {
  if (kind == "F" && size == 4) return ScalarType::kFloat32;
  if (kind == "F" && size == 8) return ScalarType::kFloat64;
  const int sign = kind == "U" ? 1 : 0;
  if (kind != "I" && kind != "U") return std::nullopt;
  // The integer types are listed by size, signed before unsigned.
  switch (size) {
    case 1:
    case 2:
    case 4:
    case 8:
      return static_cast<ScalarType>(2 * (std::bit_width(size) - 1) + sign);
    default:
      return std::nullopt;
  }
}

std::vector<Field> join_fields(const LineScanner& scanner, const RawHeader& raw) {
  const std::size_t count = raw.names.size();
  if (count == 0) scanner.fail("the header has no FIELDS line before DATA");
  if (raw.sizes.size() != count || raw.types.size() != count ||
      (!raw.counts.empty() && raw.counts.size() != count)) {
    scanner.fail(
        fmt::format("FIELDS names {} fields, SIZE {}, TYPE {} and COUNT {}; expected as "
                    "many on every line",
                    count, raw.sizes.size(), raw.types.size(), raw.counts.size()));
  }
  std::vector<Field> fields;
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<ScalarType> type = scalar_type(raw.types[i], raw.sizes[i]);
    if (!type) {
      scanner.fail(
          fmt::format("field {} has TYPE {} and SIZE {}; expected I or U with 1, 2, 4 or "
                      "8, or F with 4 or 8",
                      in_quotes(raw.names[i]), in_quotes(raw.types[i]), raw.sizes[i]));
    }
    const std::size_t repeats = raw.counts.empty() ? 1 : raw.counts[i];
    if (repeats == 0 || repeats > std::numeric_limits<std::uint32_t>::max()) {
      scanner.fail(fmt::format("field {} has COUNT {}; expected 1 or more", in_quotes(raw.names[i]),
                               repeats));
    }
    fields.push_back({raw.names[i], *type, repeats});
  }
  return fields;
}

std::size_t point_count(const LineScanner& scanner, const RawHeader& raw) {
  if (!raw.points && !(raw.width && raw.height)) {
    scanner.fail("the header has neither POINTS nor WIDTH and HEIGHT before DATA");
  }
  if (!(raw.width && raw.height)) return *raw.points;
  std::size_t product = 0;
  const bool overflow = __builtin_mul_overflow(*raw.width, *raw.height, &product);
  if (overflow || product != raw.points.value_or(product)) {
    scanner.fail(fmt::format("WIDTH {} times HEIGHT {} is not POINTS {}; the header is damaged",
                             *raw.width, *raw.height, raw.points.value_or(0)));
  }
  return product;
}

Header join(const LineScanner& scanner, const RawHeader& raw, std::string_view data) {
  Header header;
  header.fields = join_fields(scanner, raw);
  header.points = point_count(scanner, raw);
  for (const Field& field : header.fields) header.row_bytes += field.bytes();
  if (data == "ascii") {
    header.data = Data::kAscii;
  } else if (data == "binary") {
    header.data = Data::kBinary;
  } else if (data == "binary_compressed") {
    header.data = Data::kCompressed;
  } else {
    scanner.fail("DATA is " + in_quotes(data) + "; expected ascii, binary or binary_compressed");
  }
  return header;
}

Header parse_header(LineScanner& scanner) {
  RawHeader raw;
  while (scanner.next()) {
    std::string_view rest = trimmed(scanner.line());
    if (rest.empty() || rest.starts_with('#')) continue;
    const std::string_view key = next_token(rest);
    if (key == "FIELDS" || key == "COLUMNS") {
      raw.names = words(rest);
    } else if (key == "SIZE") {
      raw.sizes = integers(scanner, rest, key);
    } else if (key == "TYPE") {
      raw.types = words(rest);
    } else if (key == "COUNT") {
      raw.counts = integers(scanner, rest, key);
    } else if (key == "WIDTH") {
      raw.width = scanner.integer<std::uint64_t>(rest, key);
    } else if (key == "HEIGHT") {
      raw.height = scanner.integer<std::uint64_t>(rest, key);
    } else if (key == "POINTS") {
      raw.points = scanner.integer<std::uint64_t>(rest, key);
    } else if (key == "DATA") {
      return join(scanner, raw, trimmed(rest));
    } else if (key != "VERSION" && key != "VIEWPOINT") {
      scanner.fail("unknown header line " + in_quotes(scanner.line()) +
                   "; expected VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, VIEWPOINT, "
                   "POINTS or DATA");
    }
  }
  scanner.fail("the file ends within the header; expected DATA");
}

// ---- points ----

// Fields of one scalar are columns; `rgb` and `rgba`, colours packed into one number, make no sense
// outside PCD, and fields of several scalars are histograms and the like.
bool is_column(const Field& field) {
  return field.count == 1 && field.name != "rgb" && field.name != "rgba";
}

PointTable make_table(const std::string& place, const Header& header) {
  std::vector<Column> columns;
  for (const Field& field : header.fields) {
    if (is_column(field)) columns.push_back({field.name, field.type});
  }
  return {place, columns, header.points};
}

PointCloud read_ascii(LineScanner& scanner, const Header& header) {
  std::size_t scalars = 0;
  for (const Field& field : header.fields) scalars += field.count;
  check_count(scanner.place(), header.points, 2 * scalars, scanner.remaining(), "points");
  PointTable table = make_table(scanner.place(), header);
  for (std::size_t row = 0; row < header.points; ++row) {
    scanner.require_line('#', fmt::format("point {} of {}", row, header.points));
    std::string_view rest = scanner.line();
    std::size_t column = 0;
    for (const Field& field : header.fields) {
      if (!is_column(field)) {
        for (std::size_t i = 0; i < field.count; ++i) scanner.number(rest, field.name);
        continue;
      }
      const double value = scanner.scalar(rest, field.type, field.name);
      if (table.is_coordinate(column) && !std::isfinite(value)) {
        scanner.fail(
            fmt::format("{} is {}; expected a finite number, so remove invalid points first",
                        field.name, value));
      }
      table.set(column++, value);
    }
    if (!next_token(rest).empty()) {
      scanner.fail(fmt::format("more values than the {} that the header declares", scalars));
    }
    table.end_row();
  }
  return table.take();
}

// Where the scalars of a field are: those of point i begin at begin + i * stride.
struct Layout {
  std::size_t begin = 0;
  std::size_t stride = 0;
};

PointCloud read_binary(const Source& source, const Header& header, const char* data,
                       const std::vector<Layout>& layouts) {
  PointTable table = make_table(source.name, header);
  for (std::size_t row = 0; row < header.points; ++row) {
    std::size_t column = 0;
    for (std::size_t i = 0; i < layouts.size(); ++i) {
      if (!is_column(header.fields[i])) continue;
      const char* from = data + layouts[i].begin + row * layouts[i].stride;
      table.set(column++, load_scalar(from, header.fields[i].type, std::endian::little));
    }
    table.end_row();
  }
  PointCloud cloud = table.take();
  require_finite(source.name, cloud.points);
  return cloud;
}

PointCloud read_packed(const Source& source, const Header& header, std::size_t offset) {
  ByteReader reader(source, offset);
  check_count(source.name, header.points, header.row_bytes, reader.remaining(), "points");
  const char* data = reader.take(header.points * header.row_bytes, "the points");
  std::vector<Layout> layouts;
  std::size_t begin = 0;
  for (const Field& field : header.fields) {
    layouts.push_back({begin, header.row_bytes});
    begin += field.bytes();
  }
  return read_binary(source, header, data, layouts);
}

PointCloud read_compressed(const Source& source, const Header& header, std::size_t offset) {
  // LZF's longest match, 264 bytes, takes 3 bytes.
  constexpr std::size_t kMaxRatio = 88;
  ByteReader reader(source, offset);
  const auto packed_size = reader.read<std::uint32_t>("the compressed size");
  const auto size = reader.read<std::uint32_t>("the uncompressed size");
  check_count(source.name, header.points, header.row_bytes, size, "points");
  if (size != header.points * header.row_bytes) {
    reader.fail(fmt::format("the data unpack to {} bytes; expected {} points of {} bytes", size,
                            header.points, header.row_bytes));
  }
  const std::size_t packed_at = reader.offset();
  const char* packed = reader.take(packed_size, "the compressed points");
  std::string data;
  if (size / kMaxRatio <= packed_size) {
    data.resize(size);
    if (lzf_decompress(packed, packed_size, data.data(), size) != size) data.clear();
  }
  if (data.size() != size) {
    fail_at_byte(
        source.name, packed_at,
        fmt::format("the compressed points are damaged; expected LZF data of {} bytes", size));
  }
  std::vector<Layout> layouts;
  std::size_t begin = 0;
  for (const Field& field : header.fields) {
    layouts.push_back({begin, field.bytes()});
    begin += header.points * field.bytes();
  }
  return read_binary(source, header, data.data(), layouts);
}

}  // namespace

Geometry read_pcd(const Source& source) {
  LineScanner scanner(source, '\n');
  const Header header = parse_header(scanner);
  switch (header.data) {
    case Data::kAscii:
      return {read_ascii(scanner, header), {}};
    case Data::kBinary:
      return {read_packed(source, header, scanner.offset()), {}};
    case Data::kCompressed:
      return {read_compressed(source, header, scanner.offset()), {}};
  }
  return {};
}

}  // namespace morsel::io
