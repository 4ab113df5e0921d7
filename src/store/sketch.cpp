// From the stages of a segmentation to the little that is stored of it, and to bytes and back.

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <morsel/picture.hpp>
#include <morsel/sketch.hpp>
#include <utility>

#include "base/box.hpp"
#include "base/morton.hpp"
#include "io/bytes.hpp"
#include "picture/png.hpp"

namespace morsel {
namespace {

constexpr std::size_t kMostPoints = 2000;
constexpr std::uint8_t kVersion = 2;
constexpr int kBits = 8;  // of a coordinate
constexpr std::uint32_t kMostSteps = (1U << kBits) - 1;

// The part of each point that went on to the triangulation.
std::vector<int> parts_of_denoised(const Segmentation& s) {
  std::vector<int> parts(s.denoised.points.size(), -1);
  for (std::size_t i = 0; i < s.labels.size(); ++i) {
    if (s.denoised.stand_in[i] != kNoStandIn) parts[s.denoised.stand_in[i]] = s.labels[i];
  }
  return parts;
}

std::vector<Merge> merges_of_parts(const Segmentation& s) {
  std::vector<Merge> merges;
  for (Merge merge : s.tree.merges) {
    const int a = s.parts.part_of_piece[merge.a];
    const int b = s.parts.part_of_piece[merge.b];
    if (a == b) continue;
    merge.a = static_cast<std::uint32_t>(std::min(a, b));
    merge.b = static_cast<std::uint32_t>(std::max(a, b));
    merges.push_back(merge);
  }
  return merges;
}

void choose_grid(Sketch& sketch) {
  if (sketch.points.empty()) return;
  const Box box = bounding_box(sketch.points);
  sketch.origin = box.low;
  sketch.step = box.longest_side() / kMostSteps;
}

// The place of a grid point along a Morton curve: the bits of its coordinates in turn.
std::uint32_t place_of(const Vec3& point, const Sketch& sketch) {
  const Vec3 offset = point - sketch.origin;
  const auto bits = [&](double along) {
    const auto steps =
        sketch.step > 0.0 ? static_cast<std::uint32_t>(std::lround(along / sketch.step)) : 0U;
    return spread_bits(std::min(steps, kMostSteps));
  };
  return static_cast<std::uint32_t>(bits(offset.x) | bits(offset.y) << 1 | bits(offset.z) << 2);
}

Vec3 point_at(std::uint32_t place, const Sketch& sketch) {
  std::array<std::uint32_t, 3> steps{};
  for (int bit = 0; bit < kBits; ++bit) {
    for (int axis = 0; axis < 3; ++axis) {
      steps[static_cast<std::size_t>(axis)] |= ((place >> (3 * bit + axis)) & 1U) << bit;
    }
  }
  return sketch.origin + sketch.step * Vec3{static_cast<double>(steps[0]),
                                            static_cast<double>(steps[1]),
                                            static_cast<double>(steps[2])};
}

// Small numbers in few bytes: seven bits each, the highest bit says that more follow.
void append_number(std::string& bytes, std::uint32_t number) {
  for (; number >= 0x80; number >>= 7)
    io::append_bytes(bytes, static_cast<std::uint8_t>(number | 0x80));
  io::append_bytes(bytes, static_cast<std::uint8_t>(number));
}

std::uint32_t read_number(io::ByteReader& reader, const char* what) {
  std::uint32_t number = 0;
  for (int shift = 0; shift < 32; shift += 7) {
    const auto byte = reader.read<std::uint8_t>(what);
    number |= (byte & 0x7fU) << shift;
    if (byte < 0x80) return number;
  }
  reader.fail("a number of more than 32 bits");
}

std::string deflated(const std::string& bytes) {
  uLongf length = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(length, '\0');
  compress2(reinterpret_cast<Bytef*>(result.data()), &length,
            reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()),
            Z_BEST_COMPRESSION);
  result.resize(length);
  return result;
}

// The `length` bytes that deflated() was given.
std::string inflated(const std::string& bytes, std::size_t length, const io::ByteReader& reader) {
  constexpr std::size_t kMostShrinking = 1100;  // what the format can do at best
  if (length > kMostShrinking * bytes.size()) reader.fail("fewer bytes than it says");
  std::string result(length, '\0');
  auto written = static_cast<uLongf>(length);
  auto read = static_cast<uLong>(bytes.size());
  const int status = uncompress2(reinterpret_cast<Bytef*>(result.data()), &written,
                                 reinterpret_cast<const Bytef*>(bytes.data()), &read);
  if (status != Z_OK || written != length || read != bytes.size()) {
    reader.fail("bytes that cannot be inflated");
  }
  return result;
}

Vec3 read_vector(io::ByteReader& reader) {
  Vec3 v;
  for (double* x : {&v.x, &v.y, &v.z}) *x = reader.read<double>("the origin");
  return v;
}

}  // namespace

Sketch make_sketch(const Segmentation& segmentation) {
  const Segmentation& s = segmentation;
  Sketch sketch;
  sketch.part_count = static_cast<int>(s.parts.parts.size());
  sketch.merges = merges_of_parts(s);
  // The denoised points lie along a space-filling curve, so every k-th of them covers the surface.
  const std::vector<int> part = parts_of_denoised(s);
  const std::size_t count = part.size();
  const std::size_t kept = std::min(count, kMostPoints);
  for (std::size_t k = 0; k < kept; ++k) {
    const std::size_t i = k * count / kept;
    sketch.points.push_back(s.denoised.points[i]);
    sketch.parts.push_back(part[i]);
  }
  choose_grid(sketch);
  return decode_sketch(encode_sketch(sketch), "sketch");
}

std::string encode_sketch(const Sketch& sketch) {
  // Grouped by part, along a curve within each: neighbours differ by little, which takes few bytes.
  std::vector<std::vector<std::uint32_t>> places(static_cast<std::size_t>(sketch.part_count) + 1);
  for (std::size_t i = 0; i < sketch.points.size(); ++i) {
    // First come those of no part.
    places[static_cast<std::size_t>(sketch.parts[i] + 1)].push_back(
        place_of(sketch.points[i], sketch));
  }
  std::string bytes;
  append_number(bytes, static_cast<std::uint32_t>(sketch.part_count));
  append_number(bytes, static_cast<std::uint32_t>(sketch.merges.size()));
  for (const Merge& merge : sketch.merges) {
    io::append_bytes(bytes, static_cast<float>(merge.ratio));
    append_number(bytes, merge.a);
    append_number(bytes, merge.b);
  }
  for (const double x : {sketch.origin.x, sketch.origin.y, sketch.origin.z, sketch.step}) {
    io::append_bytes(bytes, x);
  }
  for (std::vector<std::uint32_t>& group : places) {
    std::sort(group.begin(), group.end());
    append_number(bytes, static_cast<std::uint32_t>(group.size()));
    std::uint32_t last = 0;
    for (const std::uint32_t place : group)
      append_number(bytes, place - std::exchange(last, place));
  }
  std::string result;
  io::append_bytes(result, kVersion);
  append_number(result, static_cast<std::uint32_t>(bytes.size()));
  return result + deflated(bytes);
}

Sketch decode_sketch(std::string bytes, const std::string& name) {
  const io::Source stored{name, {}, {}, std::move(bytes)};
  io::ByteReader head(stored, 0);
  if (const int version = head.read<std::uint8_t>("the version"); version != kVersion) {
    head.fail(fmt::format("version {} of a sketch; expected {}", version, kVersion));
  }
  const std::uint32_t length = read_number(head, "the length");
  const io::Source source{name, {}, {}, inflated(stored.bytes.substr(head.offset()), length, head)};
  io::ByteReader reader(source, 0);
  Sketch sketch;
  const std::uint32_t part_count = read_number(reader, "the number of parts");
  const std::uint32_t merge_count = read_number(reader, "the number of merges");
  // Each takes a byte at least.
  if (part_count > reader.remaining() || merge_count > reader.remaining()) {
    reader.fail("more parts or merges than there are bytes");
  }
  sketch.part_count = static_cast<int>(part_count);
  for (std::uint32_t i = 0; i < merge_count; ++i) {
    Merge merge;
    merge.significant = true;
    merge.ratio = static_cast<double>(reader.read<float>("a merge"));
    merge.a = read_number(reader, "a merge");
    merge.b = read_number(reader, "a merge");
    if (!(merge.ratio >= 1.0) || merge.a >= part_count || merge.b >= part_count) {
      reader.fail("a merge of parts that are not there");
    }
    sketch.merges.push_back(merge);
  }
  sketch.origin = read_vector(reader);
  sketch.step = reader.read<double>("the step");
  if (!is_finite(sketch.origin) || !std::isfinite(sketch.step))
    reader.fail("a grid without bounds");
  for (int part = -1; part < sketch.part_count; ++part) {
    const std::uint32_t count = read_number(reader, "the points of a part");
    if (count > reader.remaining()) reader.fail("more points than there are bytes");
    if (count > kMostPoints - sketch.points.size()) {
      reader.fail(fmt::format("more than {} points", kMostPoints));
    }
    std::uint32_t place = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      place += read_number(reader, "a point");
      sketch.points.push_back(point_at(place, sketch));
      sketch.parts.push_back(part);
    }
  }
  if (reader.remaining() > 0) reader.fail("bytes after the last point");
  return sketch;
}

std::string draw_thumbnail(const Sketch& sketch, std::size_t width) {
  PictureOptions options;
  options.width = width;
  options.views = 1;
  return picture::encode_png(render_parts(sketch.points, sketch.parts, options), "thumbnail");
}

}  // namespace morsel
