// Labels and labelled points out. Every file appears complete or not at all.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <morsel/color.hpp>
#include <morsel/error.hpp>
#include <morsel/io.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/lower_case.hpp"
#include "io/bytes.hpp"
#include "io/zip.hpp"

namespace morsel {
namespace {

using io::append_bytes;

// Gathers bytes and hands them to the stream in large pieces.
class Output {
 public:
  explicit Output(std::ostream& stream) : stream_(stream) {}

  std::string& buffer() { return buffer_; }
  void flush_if_large() {
    if (buffer_.size() >= (std::size_t{1} << 20)) flush();
  }
  void flush() {
    stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

 private:
  std::ostream& stream_;
  std::string buffer_;
};

// The shortest text that reads back as exactly `value`.
template <class T>
void append_number(std::string& to, T value) {
  std::array<char, 32> text;
  to.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

bool fits_float(const std::vector<Vec3>& points) {
  const auto exact = [](double value) {
    return std::abs(value) <= std::numeric_limits<float>::max() &&
           static_cast<double>(static_cast<float>(value)) == value;
  };
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec3& p) { return exact(p.x) && exact(p.y) && exact(p.z); });
}

void append_point(std::string& to, const Vec3& p, bool as_float) {
  for (const double value : {p.x, p.y, p.z}) {
    if (as_float) {
      append_bytes(to, static_cast<float>(value));
    } else {
      append_bytes(to, value);
    }
  }
}

// ---- PLY ----

template <class T>
constexpr std::string_view ply_type() {
  if constexpr (std::is_same_v<T, std::int8_t>) return "char";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "uchar";
  if constexpr (std::is_same_v<T, std::int16_t>) return "short";
  if constexpr (std::is_same_v<T, std::uint16_t>) return "ushort";
  if constexpr (std::is_same_v<T, std::int32_t>) return "int";
  if constexpr (std::is_same_v<T, std::uint32_t>) return "uint";
  if constexpr (std::is_same_v<T, float>) return "float";
  if constexpr (std::is_same_v<T, double>) return "double";
}

// The input's properties but for those that the result replaces.
std::vector<const PointProperty*> kept_properties(const PointCloud& cloud) {
  constexpr std::array<std::string_view, 7> kReplaced = {"x",     "y",    "z",   "red",
                                                         "green", "blue", "part"};
  std::vector<const PointProperty*> kept;
  for (const PointProperty& property : cloud.properties) {
    if (std::find(kReplaced.begin(), kReplaced.end(), property.name) == kReplaced.end()) {
      kept.push_back(&property);
    }
  }
  return kept;
}

std::string ply_header(std::size_t points, std::string_view coordinate,
                       const std::vector<const PointProperty*>& kept) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment made by morsel\n"
      "element vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n",
      points, coordinate, coordinate, coordinate);
  for (const PointProperty* property : kept) {
    std::visit(
        [&](const auto& values) {
          using T = typename std::remove_cvref_t<decltype(values)>::value_type;
          header += fmt::format("property {} {}\n", ply_type<T>(), property->name);
        },
        property->values);
  }
  return header +
         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
         "property int part\nend_header\n";
}

void write_ply(Output& out, const PointCloud& cloud, std::span<const int> labels) {
  const std::vector<const PointProperty*> kept = kept_properties(cloud);
  const bool as_float = fits_float(cloud.points);
  std::string& bytes = out.buffer();
  bytes = ply_header(cloud.points.size(), as_float ? "float" : "double", kept);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    append_point(bytes, cloud.points[i], as_float);
    for (const PointProperty* property : kept) {
      std::visit([&](const auto& values) { append_bytes(bytes, values[i]); }, property->values);
    }
    for (const std::uint8_t channel : part_color(labels[i])) append_bytes(bytes, channel);
    append_bytes<std::int32_t>(bytes, labels[i]);
    out.flush_if_large();
  }
}

// ---- PCD ----

void write_pcd(Output& out, const PointCloud& cloud, std::span<const int> labels) {
  const bool as_float = fits_float(cloud.points);
  const std::size_t n = cloud.points.size();
  std::string& bytes = out.buffer();
  bytes = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb part\n"
      "SIZE {0} {0} {0} 4 4\nTYPE F F F F I\nCOUNT 1 1 1 1 1\nWIDTH {1}\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {1}\nDATA binary\n",
      as_float ? 4 : 8, n);
  for (std::size_t i = 0; i < n; ++i) {
    append_point(bytes, cloud.points[i], as_float);
    // The Point Cloud Library packs a colour into the bits of a float.
    const auto [red, green, blue] = part_color(labels[i]);
    append_bytes(bytes, (std::uint32_t{red} << 16) | (std::uint32_t{green} << 8) | blue);
    append_bytes<std::int32_t>(bytes, labels[i]);
    out.flush_if_large();
  }
}

// ---- text ----

void write_xyz(Output& out, const PointCloud& cloud, std::span<const int> labels) {
  std::string& text = out.buffer();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (const double value : {cloud.points[i].x, cloud.points[i].y, cloud.points[i].z}) {
      append_number(text, value);
      text += ' ';
    }
    append_number(text, labels[i]);
    text += '\n';
    out.flush_if_large();
  }
}

// ---- NPZ ----

std::string npy_header(std::string_view type, const std::string& shape) {
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kBeforeText = 10;
  std::string text =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, shape);
  text.append(kAlignment - 1 - (kBeforeText + text.size()) % kAlignment, ' ');
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  append_bytes(header, static_cast<std::uint16_t>(text.size()));
  return header + text;
}

void write_npz(const std::filesystem::path& path, std::ostream& stream, const PointCloud& cloud,
               std::span<const int> labels) {
  constexpr std::size_t kBytesPerPoint = 3 * sizeof(double) + sizeof(std::int32_t);
  constexpr std::size_t kOverhead = 4096;
  if (cloud.points.size() > (std::size_t{UINT32_MAX} - kOverhead) / kBytesPerPoint) {
    throw Error(ErrorCode::kOutput,
                path.string() + ": more points than an .npz of 4 GiB holds; write .ply instead");
  }
  io::ZipWriter zip(stream);
  std::string points = npy_header("<f8", fmt::format("{}, 3", cloud.points.size()));
  for (const Vec3& p : cloud.points) append_point(points, p, false);
  zip.add("points.npy", points);
  std::string parts = npy_header("<i4", fmt::format("{},", labels.size()));
  for (const int label : labels) append_bytes<std::int32_t>(parts, label);
  zip.add("labels.npy", parts);
  zip.finish();
}

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = lower_case(path.extension().string());
  constexpr std::array<std::string_view, 4> kKnown = {".ply", ".pcd", ".xyz", ".npz"};
  if (std::find(kKnown.begin(), kKnown.end(), extension) == kKnown.end()) {
    throw Error(ErrorCode::kUsage, fmt::format("{}: cannot write points as '{}'; expected .ply, "
                                               ".pcd, .xyz or .npz",
                                               path.string(), extension));
  }
  return extension;
}

void check_sizes(const PointCloud& cloud, std::size_t labels) {
  const std::size_t points = cloud.points.size();
  if (labels != points) {
    throw Error(ErrorCode::kUsage, fmt::format("there are {} labels for {} points; expected one "
                                               "a point",
                                               labels, points));
  }
  for (const PointProperty& property : cloud.properties) {
    const std::size_t values =
        std::visit([](const auto& column) { return column.size(); }, property.values);
    if (values == points) continue;
    throw Error(ErrorCode::kUsage, fmt::format("property '{}' has {} values for {} points; "
                                               "expected one a point",
                                               property.name, values, points));
  }
}

}  // namespace

void write_labels(const std::filesystem::path& path, std::span<const int> labels) {
  AtomicFile file(path);
  Output out(file.stream());
  for (const int label : labels) {
    append_number(out.buffer(), label);
    out.buffer() += '\n';
    out.flush_if_large();
  }
  out.flush();
  file.commit();
}

void write_points(const std::filesystem::path& path, const PointCloud& cloud,
                  std::span<const int> labels) {
  const std::string extension = extension_of(path);
  check_sizes(cloud, labels.size());
  AtomicFile file(path);
  Output out(file.stream());
  if (extension == ".ply") write_ply(out, cloud, labels);
  if (extension == ".pcd") write_pcd(out, cloud, labels);
  if (extension == ".xyz") write_xyz(out, cloud, labels);
  if (extension == ".npz") write_npz(path, file.stream(), cloud, labels);
  out.flush();
  file.commit();
}

}  // namespace morsel
