#include "io/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "io/scanner.hpp"
#include "io/stl.hpp"

namespace morsel::io {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kKnownFormats =
    "PLY, PCD, XYZ/TXT/PTS/CSV, OFF, OBJ, STL, NPY, LAS or glTF/GLB";

// Content that is something else for certain, and what to do about it.
void reject_foreign(const Source& source) {
  struct Foreign {
    std::string_view magic;
    std::string_view message;
  };
  constexpr std::array<Foreign, 15> kForeign = {{
      {"\x1f\x8b"sv, "is compressed by gzip; decompress it first (gunzip)"},
      {"BZh"sv, "is compressed by bzip2; decompress it first (bunzip2)"},
      {"\xfd\x37zXZ\0"sv, "is compressed by xz; decompress it first (unxz)"},
      {"\x28\xb5\x2f\xfd"sv, "is compressed by zstd; decompress it first (unzstd)"},
      {"7z\xbc\xaf"sv, "is a 7z archive; unpack it first"},
      {"PK\x03\x04"sv, "is a zip archive (or .npz); unpack it first"},
      {"ASTM-E57"sv, "is an E57 scan; convert it to PLY or LAS first"},
      {"\x89HDF"sv, "is HDF5; save the points as PLY or NPY first"},
      {"\x89PNG"sv, "is a PNG picture; expected a point cloud or mesh"},
      {"\xff\xd8\xff"sv, "is a JPEG picture; expected a point cloud or mesh"},
      {"%PDF"sv, "is a PDF document; expected a point cloud or mesh"},
      {"Kaydara FBX"sv, "is FBX; convert it to OBJ or glTF first"},
      {"\xff\xfe"sv, "is UTF-16 text; save it as plain or UTF-8 text"},
      {"\xfe\xff"sv, "is UTF-16 text; save it as plain or UTF-8 text"},
      {"version https://git-lfs"sv,
       "is a Git LFS pointer; get the file itself with 'git lfs pull'"},
  }};
  for (const Foreign& foreign : kForeign) {
    if (source.bytes.starts_with(foreign.magic)) fail(source.name, std::string(foreign.message));
  }
}

std::optional<Format> by_magic(const Source& source) {
  const std::string& bytes = source.bytes;
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return Format::kPly;
  if (bytes.starts_with("\x93NUMPY")) return Format::kNpy;
  if (bytes.starts_with("LASF")) return Format::kLas;
  if (bytes.starts_with("glTF")) return Format::kGltf;
  if (bytes.starts_with("# .PCD")) return Format::kPcd;
  if (has_binary_stl_size(source)) return Format::kStl;
  return std::nullopt;
}

// A keyword of OFF, maybe with the first count stuck to it.
bool is_off_keyword(std::string_view word) {
  const std::size_t at = word.find("OFF");
  return at != std::string_view::npos &&
         word.substr(0, at).find_first_not_of("STCN4n") == std::string_view::npos &&
         word.substr(at + 3).find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_number(std::string_view word) {
  double ignored = 0.0;
  return parse_double(word, ignored) == NumberResult::kOk;
}

// OBJ has no magic: statements of OBJ only, among them a vertex, in the first lines.
bool begins_like_obj(const Source& source) {
  constexpr std::array<std::string_view, 13> kKeywords = {
      "v", "vt", "vn", "vp", "f", "o", "g", "s", "l", "p", "mtllib", "usemtl", "usemap"};
  LineScanner scanner(source);
  for (int lines = 0; lines < 100 && scanner.next_content('#'); ++lines) {
    std::string_view rest = scanner.line();
    const std::string_view keyword = next_token(rest);
    if (std::find(kKeywords.begin(), kKeywords.end(), keyword) == kKeywords.end()) return false;
    if (keyword == "v") return is_number(next_token(rest));
  }
  return false;
}

std::optional<Format> by_text(const Source& source) {
  LineScanner scanner(source);
  if (!scanner.next_content('#')) return std::nullopt;
  std::string_view rest = scanner.line();
  const std::string_view word = next_token(rest);
  if (word == "VERSION" || (word == "FIELDS" && !trimmed(rest).empty())) return Format::kPcd;
  if (is_off_keyword(word)) return Format::kOff;
  if (word.starts_with('<')) {
    fail(source.name, "is XML or HTML, as of a failed download; expected a point cloud or mesh");
  }
  const std::string_view head = std::string_view(source.bytes).substr(0, 2000);
  if (word.starts_with('{') && head.find('"') != std::string_view::npos) return Format::kGltf;
  if (equal_ignoring_case(word, "solid") && (head.find("facet") != std::string_view::npos ||
                                             head.find("FACET") != std::string_view::npos)) {
    return Format::kStl;
  }
  if (begins_like_obj(source)) return Format::kObj;
  return std::nullopt;
}

// Formats that begin with something that was not found; their readers would only repeat that.
void reject_contradiction(const Source& source) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kBeginnings = {{
      {".ply", "PLY file; expected it to begin with the line 'ply'"},
      {".pcd", "PCD file; expected it to begin with '# .PCD' or VERSION"},
      {".npy", "NPY file; expected it to begin with the bytes \\x93NUMPY"},
      {".las", "LAS file; expected it to begin with 'LASF'"},
      {".laz", "LAS file; expected it to begin with 'LASF'"},
      {".glb", "GLB file; expected it to begin with 'glTF'"},
  }};
  for (const auto& [extension, wanted] : kBeginnings) {
    if (source.extension != extension) continue;
    fail(source.name, fmt::format("begins with {} and so is not a {}",
                                  in_quotes(std::string_view(source.bytes).substr(0, 16)), wanted));
  }
}

std::optional<Format> by_extension(const std::string& extension) {
  constexpr std::array<std::pair<std::string_view, Format>, 10> kExtensions = {{
      {".off", Format::kOff},
      {".obj", Format::kObj},
      {".stl", Format::kStl},
      {".gltf", Format::kGltf},
      {".xyz", Format::kText},
      {".txt", Format::kText},
      {".pts", Format::kText},
      {".csv", Format::kText},
      {".asc", Format::kText},
      {".tsv", Format::kText},
  }};
  for (const auto& [known, format] : kExtensions) {
    if (known == extension) return format;
  }
  return std::nullopt;
}

// Without a known extension only text may still be points.
void reject_binary(const Source& source) {
  const std::string_view head = std::string_view(source.bytes).substr(0, 4096);
  const auto control = std::find_if(head.begin(), head.end(), is_control);
  if (control == head.end()) return;
  fail_at_byte(source.name, static_cast<std::size_t>(control - head.begin()),
               fmt::format("binary data of no known format, beginning with {}; expected {}",
                           in_quotes(head.substr(0, 8)), kKnownFormats));
}

}  // namespace

Format detect_format(const Source& source) {
  if (source.bytes.empty()) {
    fail(source.name, fmt::format("is empty; expected {}", kKnownFormats));
  }
  reject_foreign(source);
  if (const auto format = by_magic(source)) return *format;
  if (const auto format = by_text(source)) return *format;
  reject_contradiction(source);
  if (const auto format = by_extension(source.extension)) return *format;
  reject_binary(source);
  return Format::kText;
}

}  // namespace morsel::io
