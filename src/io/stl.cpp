// STL: triangles as text or binary, each with its own three vertices.
// Source: 3D Systems, "StereoLithography Interface Specification", 1989.
#include "io/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "io/bytes.hpp"
#include "io/geometry.hpp"
#include "io/scanner.hpp"

namespace morsel::io {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kTriangleBytes = 50;  // normal, three vertices of floats, two bytes
constexpr std::size_t kNormalBytes = 12;

void append_last_three(Geometry& geometry) {
  const auto end = static_cast<std::uint32_t>(geometry.cloud.points.size());
  geometry.triangles.push_back({end - 3, end - 2, end - 1});
}

Geometry read_binary(const Source& source) {
  ByteReader reader(source, 0);
  reader.take(kHeaderBytes, "the header");
  const auto triangles = reader.read<std::uint32_t>("the number of triangles");
  check_count(source.name, triangles, kTriangleBytes, reader.remaining(), "triangles");
  Geometry geometry;
  geometry.cloud.points.reserve(std::size_t{3} * triangles);
  geometry.triangles.reserve(triangles);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const char* corner = reader.take(kTriangleBytes, "a triangle") + kNormalBytes;
    for (int k = 0; k < 3; ++k, corner += 12) {
      geometry.cloud.points.push_back(
          {load_as<float>(corner), load_as<float>(corner + 4), load_as<float>(corner + 8)});
    }
    append_last_three(geometry);
  }
  require_finite(source.name, geometry.cloud.points);
  return geometry;
}

class TextReader {
 public:
  explicit TextReader(const Source& source) : scanner_(source) {}

  Geometry read() {
    while (scanner_.next_content('\0')) {
      std::string_view rest = scanner_.line();
      const std::string_view keyword = next_token(rest);
      const auto is = [keyword](std::string_view word) {
        return equal_ignoring_case(keyword, word);
      };
      if (is("vertex")) {
        read_vertex(rest);
      } else if (is("facet")) {
        corners_ = 0;
      } else if (is("endfacet")) {
        end_facet();
      } else if (is("solid") || is("endsolid")) {
        inside_solid_ = is("solid");
      } else if (!is("outer") && !is("endloop")) {
        scanner_.fail("unknown line " + in_quotes(scanner_.line()) +
                      "; expected solid, facet, outer loop, vertex, endloop, endfacet or endsolid");
      }
    }
    if (inside_solid_) scanner_.fail("the file ends here; expected 'endsolid'");
    return std::move(geometry_);
  }

 private:
  void read_vertex(std::string_view rest) {
    const double x = scanner_.finite(rest, "x");
    const double y = scanner_.finite(rest, "y");
    const double z = scanner_.finite(rest, "z");
    geometry_.cloud.points.push_back({x, y, z});
    ++corners_;
  }
  void end_facet() {
    if (corners_ != 3) {
      scanner_.fail(fmt::format("a facet of {} vertices; expected 3", corners_));
    }
    append_last_three(geometry_);
    corners_ = 0;
  }

  LineScanner scanner_;
  Geometry geometry_;
  int corners_ = 0;
  bool inside_solid_ = false;
};

}  // namespace

bool has_binary_stl_size(const Source& source) {
  if (source.bytes.size() < kHeaderBytes + 4 + kTriangleBytes) return false;
  const auto triangles = load_as<std::uint32_t>(source.bytes.data() + kHeaderBytes);
  return source.bytes.size() == kHeaderBytes + 4 + kTriangleBytes * triangles;
}

Geometry read_stl(const Source& source) {
  // Binary files may begin with "solid" too, but then hold zeros or numbers soon after.
  const std::string_view head = std::string_view(source.bytes).substr(0, kHeaderBytes + 4);
  const bool is_text = equal_ignoring_case(head.substr(0, 5), "solid") &&
                       std::none_of(head.begin(), head.end(), is_control);
  return is_text && !has_binary_stl_size(source) ? TextReader(source).read() : read_binary(source);
}

}  // namespace morsel::io
