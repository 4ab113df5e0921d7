// OBJ: the statements v (vertex) and f (polygon); all others are walked over.
// Source: Wavefront Technologies, "Advanced Visualizer Manual", appendix B1.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string>
#include <vector>

#include "io/geometry.hpp"
#include "io/scanner.hpp"

namespace morsel::io {
namespace {

class ObjReader {
 public:
  explicit ObjReader(const Source& source) : name_(source.name), scanner_(source) {}

  Geometry read() {
    std::string joined;
    while (scanner_.next_content('#')) {
      joined.append(scanner_.line());
      if (joined.ends_with('\\')) {  // the statement goes on in the next line
        joined.back() = ' ';
        continue;
      }
      read_statement(joined);
      joined.clear();
    }
    if (!joined.empty()) scanner_.fail("the file ends within a statement");
    check_indices();
    return std::move(geometry_);
  }

 private:
  void read_statement(std::string_view rest) {
    const std::string_view keyword = next_token(rest);
    if (keyword == "v") {
      read_vertex(rest);
    } else if (keyword == "f") {
      read_face(rest);
    } else if (!std::all_of(keyword.begin(), keyword.end(), [](unsigned char c) {
                 return std::isalpha(c) != 0 || c == '_' || c == '-';
               })) {
      scanner_.fail("unknown statement " + in_quotes(keyword) +
                    "; expected v, f or another OBJ keyword");
    }
  }

  void read_vertex(std::string_view rest) {
    const double x = scanner_.finite(rest, "x");
    const double y = scanner_.finite(rest, "y");
    const double z = scanner_.finite(rest, "z");
    geometry_.cloud.points.push_back({x, y, z});
  }

  void read_face(std::string_view rest) {
    corners_.clear();
    while (true) {
      std::string_view corner = next_token(rest);
      if (corner.empty()) break;
      corner = corner.substr(0, corner.find('/'));  // vertex/texture/normal
      corners_.push_back(vertex_index(corner));
    }
    if (corners_.size() < 3) {
      scanner_.fail(fmt::format("a face of {} corners; expected 3 or more", corners_.size()));
    }
    append_fan(corners_, geometry_.triangles);
  }

  // Indices count from 1; negative ones backwards from the latest vertex.
  std::uint32_t vertex_index(std::string_view token) {
    const auto index = scanner_.integer<std::int32_t>(token, "a vertex index");
    const std::size_t known = geometry_.cloud.points.size();
    if (index == 0 || (index < 0 && static_cast<std::size_t>(-std::int64_t{index}) > known)) {
      scanner_.fail(
          fmt::format("vertex index {}; expected 1 to {} or -1 to -{}", index, known, known));
    }
    if (index < 0)
      return static_cast<std::uint32_t>(known - static_cast<std::size_t>(-std::int64_t{index}));
    if (static_cast<std::size_t>(index) > largest_index_) {
      largest_index_ = static_cast<std::size_t>(index);
      largest_line_ = scanner_.line_number();
    }
    return static_cast<std::uint32_t>(index - 1);
  }

  // A face may come before its vertices, so this waits for the end of the file.
  void check_indices() const {
    const std::size_t known = geometry_.cloud.points.size();
    if (largest_index_ <= known) return;
    fail_at_line(name_, largest_line_,
                 fmt::format("vertex index {}, but the file holds {} vertices; it may be truncated",
                             largest_index_, known));
  }

  const std::string& name_;
  LineScanner scanner_;
  Geometry geometry_;
  std::vector<std::uint32_t> corners_;
  std::size_t largest_index_ = 0;
  std::size_t largest_line_ = 0;
};

}  // namespace

Geometry read_obj(const Source& source) { return ObjReader(source).read(); }

}  // namespace morsel::io
