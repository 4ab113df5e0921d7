// LAS, versions 1.0 to 1.4, uncompressed: a header with the scale and offset of the coordinates,
// then records that begin with x, y and z as 32-bit integers.
// Source: ASPRS, "LAS Specification 1.4 - R15", 2019, §2.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "io/bytes.hpp"
#include "io/geometry.hpp"

namespace morsel::io {
namespace {

// Offsets within the header.
constexpr std::size_t kMinorVersionAt = 25;
constexpr std::size_t kHeaderSizeAt = 94;
constexpr std::size_t kPointDataAt = 96;
constexpr std::size_t kPointFormatAt = 104;
constexpr std::size_t kRecordLengthAt = 105;
constexpr std::size_t kLegacyCountAt = 107;
constexpr std::size_t kScaleAt = 131;
constexpr std::size_t kOffsetAt = 155;
constexpr std::size_t kMinHeaderSize = 227;
constexpr std::size_t kCountAt = 247;  // 64 bits, since 1.4
constexpr std::size_t kHeaderSize14 = 375;

// The shortest record of point formats 0 to 10.
constexpr std::array<std::size_t, 11> kRecordLength = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

struct Header {
  std::size_t data_at = 0;
  std::size_t record_length = 0;
  std::size_t points = 0;
  std::array<double, 3> scale = {};
  std::array<double, 3> offset = {};
};

template <class T>
T field(const Source& source, std::size_t at, const char* what) {
  ByteReader reader(source, at);
  return reader.read<T>(what);
}

void check_version(const Source& source) {
  const auto major = field<std::uint8_t>(source, kMinorVersionAt - 1, "the version");
  const auto minor = field<std::uint8_t>(source, kMinorVersionAt, "the version");
  if (major != 1 || minor > 4) {
    fail_at_byte(source.name, kMinorVersionAt - 1,
                 fmt::format("LAS version {}.{}; expected 1.2 to 1.4", major, minor));
  }
}

void check_format(const Source& source, const Header& header) {
  const auto format = field<std::uint8_t>(source, kPointFormatAt, "the point format");
  // LASzip marks its files by the highest bit, or the one below, of the point format.
  if (format >= 64) {
    fail(source.name,
         "the points are compressed (LAZ); decompress it first, e.g. with laszip or "
         "'pdal translate scan.laz scan.las'");
  }
  if (format >= kRecordLength.size()) {
    fail_at_byte(source.name, kPointFormatAt,
                 fmt::format("point format {}; expected 0 to 10", format));
  }
  if (header.record_length < kRecordLength[format]) {
    fail_at_byte(source.name, kRecordLengthAt,
                 fmt::format("records of {} bytes; expected at least {} in point format {}",
                             header.record_length, kRecordLength[format], format));
  }
}

void read_transform(const Source& source, Header& header) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.scale[axis] = field<double>(source, kScaleAt + 8 * axis, "the scale");
    header.offset[axis] = field<double>(source, kOffsetAt + 8 * axis, "the offset");
    if (!std::isfinite(header.scale[axis]) || header.scale[axis] == 0.0) {
      fail_at_byte(source.name, kScaleAt + 8 * axis,
                   fmt::format("the scale of {} is {}; expected a finite number other than 0",
                               "xyz"[axis], header.scale[axis]));
    }
    if (!std::isfinite(header.offset[axis])) {
      fail_at_byte(source.name, kOffsetAt + 8 * axis,
                   fmt::format("the offset of {} is {}; expected a finite number", "xyz"[axis],
                               header.offset[axis]));
    }
  }
}

Header read_header(const Source& source) {
  ByteReader(source, 0).take(kMinHeaderSize, "the header");
  check_version(source);
  Header header;
  header.data_at = field<std::uint32_t>(source, kPointDataAt, "the start of the points");
  header.record_length = field<std::uint16_t>(source, kRecordLengthAt, "the record length");
  header.points = field<std::uint32_t>(source, kLegacyCountAt, "the number of points");
  check_format(source, header);
  read_transform(source, header);
  const bool is_14 =
      field<std::uint8_t>(source, kMinorVersionAt, "the version") == 4 &&
      field<std::uint16_t>(source, kHeaderSizeAt, "the header size") >= kHeaderSize14;
  if (is_14) {
    const auto count = field<std::uint64_t>(source, kCountAt, "the number of points");
    if (count != 0) header.points = count;
  }
  if (header.data_at < kMinHeaderSize || header.data_at > source.bytes.size()) {
    fail_at_byte(source.name, kPointDataAt,
                 fmt::format("the points begin at byte {}; expected {} to {}, the file's size",
                             header.data_at, kMinHeaderSize, source.bytes.size()));
  }
  return header;
}

}  // namespace

Geometry read_las(const Source& source) {
  const Header header = read_header(source);
  ByteReader reader(source, header.data_at);
  check_count(source.name, header.points, header.record_length, reader.remaining(), "points");
  const char* data = reader.take(header.points * header.record_length, "the points");
  Geometry geometry;
  geometry.cloud.points.reserve(header.points);
  for (std::size_t row = 0; row < header.points; ++row) {
    const auto at = [&](std::size_t axis) {
      const auto steps = load_as<std::int32_t>(data + row * header.record_length + 4 * axis);
      return steps * header.scale[axis] + header.offset[axis];
    };
    geometry.cloud.points.push_back({at(0), at(1), at(2)});
  }
  require_finite(source.name, geometry.cloud.points);
  return geometry;
}

}  // namespace morsel::io
