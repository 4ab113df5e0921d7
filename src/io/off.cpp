// OFF: a keyword with optional prefixes (ST, C, N), three counts, then vertices and polygons, one a
// line. Vertices may carry normals, colours and texture coordinates after their three coordinates.
// Source: Geomview manual, "OFF Files".
#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/geometry.hpp"
#include "io/scanner.hpp"

namespace morsel::io {
namespace {

struct Counts {
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Cuts the keyword off `rest`, which may follow directly ("OFF490 518 0", as in some public
// collections) or be missing altogether.
void skip_keyword(const LineScanner& scanner, std::string_view& rest) {
  const std::size_t at = rest.find("OFF");
  if (at == std::string_view::npos && is_digit(rest[0])) return;
  const std::string_view prefix = rest.substr(0, at);
  const bool known = prefix.empty() || prefix == "C" || prefix == "N" || prefix == "CN" ||
                     prefix == "ST" || prefix == "STC" || prefix == "STN" || prefix == "STCN" ||
                     prefix == "NC";
  if (at == std::string_view::npos || !known) {
    scanner.fail("begins with " + in_quotes(rest) +
                 "; expected OFF, COFF, NOFF or another keyword of three-dimensional OFF");
  }
  rest = trimmed(rest.substr(at + 3));
  if (rest.starts_with("BINARY")) scanner.fail("binary OFF; save it as text");
}

Counts read_counts(LineScanner& scanner) {
  scanner.require_line('#', "OFF and the numbers of vertices, faces and edges");
  std::string_view rest = scanner.line();
  skip_keyword(scanner, rest);
  if (rest.empty()) {
    scanner.require_line('#', "the numbers of vertices, faces and edges");
    rest = scanner.line();
  }
  Counts counts;
  counts.vertices = scanner.integer<std::uint64_t>(rest, "the number of vertices");
  counts.faces = scanner.integer<std::uint64_t>(rest, "the number of faces");
  check_count(scanner.place(), counts.vertices, 6, scanner.remaining(), "vertices");
  check_count(scanner.place(), counts.faces, 2, scanner.remaining() - 6 * counts.vertices, "faces");
  return counts;
}

void read_face(const LineScanner& scanner, std::size_t vertices,
               std::vector<std::uint32_t>& corners) {
  std::string_view rest = scanner.line();
  const auto size = scanner.integer<std::uint64_t>(rest, "the number of corners");
  corners.clear();
  for (std::uint64_t i = 0; i < size; ++i) {
    const auto index = scanner.integer<std::uint32_t>(rest, "a corner of the face");
    if (index >= vertices) {
      scanner.fail(fmt::format("vertex index {}; expected 0 to {}", index, vertices - 1));
    }
    corners.push_back(index);
  }
}

}  // namespace

Geometry read_off(const Source& source) {
  LineScanner scanner(source);
  const Counts counts = read_counts(scanner);
  Geometry geometry;
  geometry.cloud.points.reserve(counts.vertices);
  for (std::size_t i = 0; i < counts.vertices; ++i) {
    scanner.require_line('#', fmt::format("vertex {} of {}", i, counts.vertices));
    std::string_view rest = scanner.line();
    const double x = scanner.finite(rest, "x");
    const double y = scanner.finite(rest, "y");
    const double z = scanner.finite(rest, "z");
    geometry.cloud.points.push_back({x, y, z});
  }
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < counts.faces; ++i) {
    scanner.require_line('#', fmt::format("face {} of {}", i, counts.faces));
    read_face(scanner, counts.vertices, corners);
    append_fan(corners, geometry.triangles);
  }
  return geometry;
}

}  // namespace morsel::io
