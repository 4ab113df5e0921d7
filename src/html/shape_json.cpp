#include "html/shape_json.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <morsel/color.hpp>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "base/base64.hpp"
#include "picture/surfels.hpp"
#include "picture/views.hpp"

namespace morsel {
namespace {

using Json = nlohmann::ordered_json;
using picture::Cloud;
using picture::Surfel;

constexpr std::size_t kPaletteSize = 240;  // few cuts have more parts

template <typename Value>
std::string_view bytes_of(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

template <typename Value>
Json array_json(const char* type, const std::vector<Value>& values) {
  return {{"type", type}, {"data", encode_base64(bytes_of(values))}};
}
Json array_json(const std::vector<std::uint8_t>& values) { return array_json("u8", values); }
Json array_json(const std::vector<std::int8_t>& values) { return array_json("i8", values); }
Json array_json(const std::vector<std::uint16_t>& values) { return array_json("u16", values); }
Json array_json(const std::vector<std::uint32_t>& values) { return array_json("u32", values); }
Json array_json(const std::vector<double>& values) { return array_json("f64", values); }

Json vector_json(const Vec3& v) { return {v.x, v.y, v.z}; }

// One value of each element, as numbers of one type.
template <typename Value, typename Element, typename Get>
std::vector<Value> column(const std::vector<Element>& elements, const Get& get) {
  std::vector<Value> values;
  values.reserve(elements.size());
  for (const Element& element : elements) values.push_back(static_cast<Value>(get(element)));
  return values;
}

// Merges points on ever coarser grids until there are no more than `most`.
Cloud thin_out(Cloud cloud, std::size_t most) {
  const auto wanted = static_cast<float>(most);
  float cell = 1.0F / std::sqrt(wanted);
  while (cloud.points.size() > most) {
    Cloud merged = picture::merge_on_grid(cloud, cell);
    cell *= 1.02F * std::sqrt(std::max(1.0F, static_cast<float>(merged.points.size()) / wanted));
    if (merged.points.size() <= most) return merged;
  }
  return cloud;
}

std::uint16_t to_u16(float x) {  // of [-1, 1]
  return static_cast<std::uint16_t>(std::lround(32767.5F * (std::clamp(x, -1.0F, 1.0F) + 1.0F)));
}

// The rotation that takes x, y, z to the surfel's major and minor axis and normal, as a quaternion
// x, y, z, w in units of 1/127.
std::array<std::int8_t, 4> turn_of(const Surfel& surfel) {
  Eigen::Matrix3f axes;
  axes.col(0) = surfel.major.normalized();
  axes.col(2) = surfel.normal;
  axes.col(1) = axes.col(2).cross(axes.col(0));
  const Eigen::Quaternionf turn(axes);
  std::array<std::int8_t, 4> rounded{};
  for (int i = 0; i < 4; ++i) {
    rounded[i] = static_cast<std::int8_t>(std::lround(127.0F * turn.coeffs()[i]));
  }
  return rounded;
}

// Positions, turns, half axes and pieces of the points that are drawn.
Json points_json(const std::vector<Surfel>& surfels, std::size_t piece_count) {
  float longest = 0.0F;
  for (const Surfel& s : surfels) longest = std::max({longest, s.major.norm(), s.minor.norm()});
  std::vector<std::uint16_t> positions;
  std::vector<std::int8_t> turns;
  std::vector<std::uint8_t> radii;
  const auto radius = [&](float x) {
    return static_cast<std::uint8_t>(std::lround(std::max(1.0F, 255.0F * x / longest)));
  };
  for (const Surfel& s : surfels) {
    for (int i = 0; i < 3; ++i) positions.push_back(to_u16(s.position[i]));
    const std::array<std::int8_t, 4> turn = turn_of(s);
    turns.insert(turns.end(), turn.begin(), turn.end());
    radii.push_back(radius(s.major.norm()));
    radii.push_back(s.ball ? std::uint8_t{0} : radius(s.minor.norm()));
  }
  const auto piece = [&](const Surfel& s) {
    return s.label < 0 ? piece_count : static_cast<std::size_t>(s.label);
  };
  Json json;
  json["positions"] = array_json(positions);
  json["turns"] = array_json(turns);
  json["radii"] = array_json(radii);
  json["longest_radius"] = longest;
  json["pieces"] = piece_count < std::numeric_limits<std::uint16_t>::max()
                       ? array_json(column<std::uint16_t>(surfels, piece))
                       : array_json(column<std::uint32_t>(surfels, piece));
  return json;
}

Json tree_json(const MergeTree& tree) {
  std::vector<double> moments;  // volume, first, second
  for (const Moments& m : tree.moments) {
    moments.insert(moments.end(), {m.volume, m.first.x, m.first.y, m.first.z});
    moments.insert(moments.end(), m.second.begin(), m.second.end());
  }
  std::vector<double> centers;
  for (const Vec3& c : tree.ball_center) centers.insert(centers.end(), {c.x, c.y, c.z});
  Json json;
  json["origin"] = vector_json(tree.origin);
  json["moments"] = array_json(moments);
  json["point_count"] = array_json(tree.point_count);
  json["ball_center"] = array_json(centers);
  json["ball_radius"] = array_json(tree.ball_radius);
  json["merge_ratio"] = array_json(column<double>(tree.merges, [](auto& m) { return m.ratio; }));
  json["merge_a"] = array_json(column<std::uint32_t>(tree.merges, [](auto& m) { return m.a; }));
  json["merge_b"] = array_json(column<std::uint32_t>(tree.merges, [](auto& m) { return m.b; }));
  json["merge_significant"] =
      array_json(column<std::uint8_t>(tree.merges, [](auto& m) { return m.significant; }));
  json["neck_a"] = array_json(column<std::uint32_t>(tree.necks, [](auto& n) { return n.a; }));
  json["neck_b"] = array_json(column<std::uint32_t>(tree.necks, [](auto& n) { return n.b; }));
  json["neck_radius"] = array_json(column<double>(tree.necks, [](auto& n) { return n.radius; }));
  json["objects"] = tree.component_count;
  return json;
}

Json palette_json() {
  Json palette = Json::array();
  for (std::size_t i = 0; i < kPaletteSize; ++i) palette.push_back(part_color(static_cast<int>(i)));
  return palette;
}

// Rows of the rotation to the viewer: right, up, towards the viewer.
Json view_json(const std::vector<Surfel>& surfels) {
  std::vector<Eigen::Vector3f> positions;
  for (const Surfel& s : surfels) {
    if (!s.isolated) positions.push_back(s.position);
  }
  const Eigen::Matrix3f view = picture::choose_views(positions, 1).front();
  Json json = Json::array();
  for (int i = 0; i < 9; ++i) json.push_back(view(i / 3, i % 3));
  return json;
}

// Adds where the points are, how they are first seen and what colours there are.
void add_picture(Json& json, Cloud cloud, std::size_t most_points, std::size_t part_count) {
  json["center"] = vector_json(cloud.center);
  json["scale"] = cloud.scale;
  const std::vector<Surfel> surfels =
      picture::make_surfels(thin_out(std::move(cloud), most_points));
  json["view"] = view_json(surfels);
  json["palette"] = palette_json();
  json["points"] = points_json(surfels, part_count);
}

// For a <script> element.
std::string text_of(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace

std::string shape_json(std::span<const Vec3> points, const MergeTree& tree,
                       const HtmlOptions& options) {
  std::vector<int> pieces;
  pieces.reserve(points.size());
  for (const std::uint32_t p : tree.piece_of_point) {
    pieces.push_back(p == kNoBasin ? -1 : static_cast<int>(p));
  }
  Json json;
  json["morsel"] = version();
  json["name"] = options.name;
  json["points_of_input"] = points.size();
  json["merge_ratio"] = options.merge_ratio.value_or(tree.natural_ratio);
  add_picture(json, picture::normalize(points, pieces), options.most_points, tree.moments.size());
  json["tree"] = tree_json(tree);
  return text_of(json);
}

std::string picture_json(std::span<const Vec3> points, std::span<const int> parts,
                         std::size_t part_count) {
  Json json;
  add_picture(json, picture::normalize(points, parts), points.size(), part_count);
  return text_of(json);
}

}  // namespace morsel
