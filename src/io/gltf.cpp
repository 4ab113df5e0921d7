// glTF 2.0, as JSON with its buffers beside or within it, or as GLB: the triangles of the default
// scene, each mesh placed by the transforms of its nodes. Written over a JSON library rather than
// a model importer: those keep coordinates as floats, lose precision in the transforms and are not
// made for hostile files.
// Source: Khronos Group, "glTF 2.0 Specification", 2021, §3 and §4.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <morsel/error.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/base64.hpp"
#include "base/whole_number.hpp"
#include "io/bytes.hpp"
#include "io/geometry.hpp"

namespace morsel::io {
namespace {

using Json = nlohmann::json;

// Nodes may place one mesh many times, so a small file can ask for much memory.
constexpr std::size_t kMaxVertices = 20'000'000;
// No count or offset within a file is larger; products of a few stay within 64 bits.
constexpr std::size_t kMaxSize = std::size_t{1} << 40;

constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;

// ---- container ----

struct Container {
  std::size_t json_at = 0;
  std::string_view json;
  std::string_view binary;
};

Container split(const Source& source) {
  if (!source.bytes.starts_with("glTF")) return {0, source.bytes, {}};
  ByteReader reader(source, 4);
  const auto version = reader.read<std::uint32_t>("the header");
  const auto length = reader.read<std::uint32_t>("the header");
  if (version != 2)
    fail_at_byte(source.name, 4, fmt::format("GLB version {}; expected 2", version));
  if (length > source.bytes.size()) {
    fail_at_byte(source.name, 8,
                 fmt::format("the header promises {} bytes, the file has {}; it is truncated",
                             length, source.bytes.size()));
  }
  Container container;
  while (reader.remaining() >= 8 && reader.offset() + 8 <= length) {
    const auto size = reader.read<std::uint32_t>("a chunk's length");
    const auto type = reader.read<std::uint32_t>("a chunk's type");
    const std::size_t at = reader.offset();
    const std::string_view chunk(reader.take(size, "a chunk"), size);
    if (type == kJsonChunk && container.json.empty()) container = {at, chunk, container.binary};
    if (type == kBinaryChunk && container.binary.empty()) container.binary = chunk;
  }
  if (container.json.empty()) fail_at_byte(source.name, 12, "no JSON chunk; expected one first");
  return container;
}

Json parse_json(const Source& source, const Container& container) {
  try {
    return Json::parse(container.json.begin(), container.json.end());
  } catch (const Json::parse_error& error) {
    fail_at_byte(source.name, container.json_at + error.byte,
                 "the JSON ends early or is damaged here; expected glTF 2.0");
  }
}

// ---- buffers ----

std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    std::uint8_t byte = 0;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(uri.data() + i + 1, uri.data() + i + 3, byte, 16).ptr ==
            uri.data() + i + 3) {
      text += static_cast<char>(byte);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

// ---- document ----

// The numbers of an accessor: element i begins at data + i * stride.
struct Accessor {
  const char* data = nullptr;
  std::size_t count = 0;
  std::size_t stride = 0;
  std::size_t components = 0;
  ScalarType type = ScalarType::kFloat32;
  bool normalized = false;

  [[nodiscard]] double value(std::size_t element, std::size_t component) const {
    const double raw =
        load_scalar(data + element * stride + component * size_of(type), type, std::endian::little);
    if (!normalized || is_float(type)) return raw;
    const auto bits = static_cast<int>(8 * size_of(type)) - (is_signed(type) ? 1 : 0);
    return std::max(raw / (std::ldexp(1.0, bits) - 1.0), -1.0);
  }
};

class GltfReader {
 public:
  GltfReader(const Source& source, const Container& container)
      : source_(source), binary_(container.binary), document_(parse_json(source, container)) {}

  Geometry read() {
    check_document();
    struct Visit {
      std::size_t node;
      Eigen::Affine3d world_from_parent;
    };
    std::vector<Visit> stack;
    for (const std::size_t root : root_nodes())
      stack.push_back({root, Eigen::Affine3d::Identity()});
    std::vector<bool> seen(list("nodes").size());
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const Json& node = item("nodes", visit.node);
      if (seen[visit.node]) {
        fail(fmt::format("node {} has two parents or is its own; expected a tree", visit.node));
      }
      seen[visit.node] = true;
      const Eigen::Affine3d world_from_node = visit.world_from_parent * parent_from_node(node);
      if (node.contains("mesh")) add_mesh(item("meshes", size(node, "mesh")), world_from_node);
      for (const std::size_t child : sizes(node, "children")) {
        stack.push_back({child, world_from_node});
      }
    }
    return std::move(geometry_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { io::fail(source_.name, message); }

  // A top-level list; empty when it is not there.
  [[nodiscard]] const Json& list(const char* name) const {
    static const Json kEmpty = Json::array();
    const auto found = document_.find(name);
    return found == document_.end() ? kEmpty : *found;
  }
  [[nodiscard]] const Json& item(const char* name, std::size_t index) const {
    const Json& items = list(name);
    if (!items.is_array() || index >= items.size()) {
      fail(fmt::format("{}[{}] is referred to but missing; there are {}", name, index,
                       items.size()));
    }
    return items.at(index);
  }
  [[nodiscard]] std::size_t checked_size(const Json& value, const char* name) const {
    const auto number = whole_number<std::size_t>(value);
    if (!number || *number > kMaxSize) {
      fail(fmt::format("{} is {}; expected a non-negative integer in range", name,
                       in_quotes(value.dump(-1, ' ', true, Json::error_handler_t::replace))));
    }
    return *number;
  }
  [[nodiscard]] std::size_t size(const Json& object, const char* name) const {
    return checked_size(object.at(name), name);
  }
  [[nodiscard]] std::size_t size_or(const Json& object, const char* name,
                                    std::size_t otherwise) const {
    return object.contains(name) ? size(object, name) : otherwise;
  }
  [[nodiscard]] std::vector<std::size_t> sizes(const Json& object, const char* name) const {
    std::vector<std::size_t> result;
    if (!object.contains(name)) return result;
    for (const Json& value : object.at(name)) result.push_back(checked_size(value, name));
    return result;
  }
  [[nodiscard]] std::vector<double> numbers(const Json& object, const char* name,
                                            std::vector<double> otherwise) const {
    if (!object.contains(name)) return otherwise;
    auto result = object.at(name).get<std::vector<double>>();
    if (result.size() != otherwise.size()) {
      fail(fmt::format("{} has {} numbers; expected {}", name, result.size(), otherwise.size()));
    }
    return result;
  }

  void check_document() const {
    const auto version = document_.at("asset").at("version").get<std::string>();
    if (!version.starts_with("2.")) fail("glTF version " + in_quotes(version) + "; expected 2.0");
    for (const Json& extension : list("extensionsRequired")) {
      const auto name = extension.get<std::string>();
      if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression") {
        fail("the mesh is compressed by " + name + "; export it without compression");
      }
    }
  }

  // The roots of the default scene, or without scenes all nodes that are nobody's child.
  [[nodiscard]] std::vector<std::size_t> root_nodes() const {
    if (!list("scenes").empty()) {
      return sizes(item("scenes", size_or(document_, "scene", 0)), "nodes");
    }
    std::vector<bool> is_child(list("nodes").size());
    for (const Json& node : list("nodes")) {
      for (const std::size_t child : sizes(node, "children")) {
        if (child < is_child.size()) is_child[child] = true;
      }
    }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) roots.push_back(i);
    }
    return roots;
  }

  [[nodiscard]] Eigen::Affine3d parent_from_node(const Json& node) const {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (node.contains("matrix")) {
      const std::vector<double> matrix = numbers(node, "matrix", std::vector<double>(16));
      transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(matrix.data());  // column by column
      return transform;
    }
    const std::vector<double> t = numbers(node, "translation", {0, 0, 0});
    const std::vector<double> r = numbers(node, "rotation", {0, 0, 0, 1});
    const std::vector<double> s = numbers(node, "scale", {1, 1, 1});
    Eigen::Quaterniond rotation(r[3], r[0], r[1], r[2]);
    rotation.normalize();
    return Eigen::Translation3d(t[0], t[1], t[2]) * rotation * Eigen::Scaling(s[0], s[1], s[2]);
  }

  void add_mesh(const Json& mesh, const Eigen::Affine3d& world_from_node) {
    for (const Json& primitive : mesh.at("primitives")) {
      const std::size_t mode = size_or(primitive, "mode", 4);
      const Json& attributes = primitive.at("attributes");
      const bool has_surface = mode == 4 || mode == 5 || mode == 6;
      if (!attributes.contains("POSITION") || !(has_surface || mode == 0)) continue;
      const std::size_t first = geometry_.cloud.points.size();
      const std::size_t count = add_vertices(size(attributes, "POSITION"), world_from_node);
      if (has_surface) add_triangles(corners(primitive, first, count), mode);
    }
  }

  std::size_t add_vertices(std::size_t index, const Eigen::Affine3d& world_from_node) {
    const Accessor positions = accessor(index, "VEC3");
    std::vector<Vec3>& points = geometry_.cloud.points;
    if (points.size() + positions.count > kMaxVertices) {
      fail(fmt::format("the scene has more than {} vertices once its meshes are placed",
                       kMaxVertices));
    }
    for (std::size_t i = 0; i < positions.count; ++i) {
      const Eigen::Vector3d p =
          world_from_node *
          Eigen::Vector3d(positions.value(i, 0), positions.value(i, 1), positions.value(i, 2));
      points.push_back({p.x(), p.y(), p.z()});
    }
    return positions.count;
  }

  // The vertices that the primitive's corners refer to.
  std::vector<std::uint32_t> corners(const Json& primitive, std::size_t first, std::size_t count) {
    std::vector<std::uint32_t> result;
    const auto push = [&](std::size_t i) {
      result.push_back(static_cast<std::uint32_t>(first + i));
    };
    if (!primitive.contains("indices")) {
      for (std::size_t i = 0; i < count; ++i) push(i);
      return result;
    }
    const Accessor indices = accessor(size(primitive, "indices"), "SCALAR");
    if (is_float(indices.type)) fail("indices are floats; expected unsigned integers");
    if (geometry_.triangles.size() + indices.count > 3 * kMaxVertices) {
      fail("the scene has too many triangles once its meshes are placed");
    }
    for (std::size_t i = 0; i < indices.count; ++i) {
      const double index = indices.value(i, 0);
      if (!(index >= 0 && index < static_cast<double>(count))) {
        fail(fmt::format("corner {} has the vertex index {}; expected 0 to {}", i, index,
                         static_cast<double>(count) - 1));
      }
      push(static_cast<std::size_t>(index));
    }
    return result;
  }

  void add_triangles(const std::vector<std::uint32_t>& corners, std::size_t mode) {
    const std::size_t step = mode == 4 ? 3 : 1;
    for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
      const std::size_t anchor = mode == 6 ? 0 : i;
      // Every other triangle of a strip is turned round.
      const std::size_t flip = mode == 5 && i % 2 == 1 ? 1 : 0;
      geometry_.triangles.push_back(
          {corners[anchor], corners[i + 1 + flip], corners[i + 2 - flip]});
    }
  }

  [[nodiscard]] ScalarType component_type(const Json& accessor) const {
    const std::map<std::size_t, ScalarType> types = {
        {5120, ScalarType::kInt8},   {5121, ScalarType::kUint8},  {5122, ScalarType::kInt16},
        {5123, ScalarType::kUint16}, {5125, ScalarType::kUint32}, {5126, ScalarType::kFloat32}};
    const auto found = types.find(size(accessor, "componentType"));
    if (found == types.end()) fail("unknown componentType; expected 5120 to 5126");
    return found->second;
  }

  Accessor accessor(std::size_t index, const std::string& shape) {
    const Json& description = item("accessors", index);
    const auto reject = [&](const std::string& message) {
      fail(fmt::format("accessors[{}]: {}", index, message));
    };
    if (description.at("type").get<std::string>() != shape) reject("expected type " + shape);
    if (description.contains("sparse") || !description.contains("bufferView")) {
      reject("is sparse or compressed; export the mesh with plain buffers");
    }
    Accessor result;
    result.type = component_type(description);
    result.components = shape == "VEC3" ? 3 : 1;
    result.count = size(description, "count");
    result.normalized = description.value("normalized", false);
    const Json& view = item("bufferViews", size(description, "bufferView"));
    const std::size_t element = result.components * size_of(result.type);
    result.stride = size_or(view, "byteStride", element);
    const std::size_t begin = size_or(description, "byteOffset", 0);
    const std::size_t length = size(view, "byteLength");
    if (result.stride < element || result.stride > 252) reject("byteStride is out of range");
    if (begin > length ||
        (result.count > 0 && (result.count - 1) * result.stride + element > length - begin)) {
      reject(
          fmt::format("{} elements do not fit its buffer view of {} bytes", result.count, length));
    }
    const std::string_view bytes = buffer(size(view, "buffer"));
    const std::size_t view_begin = size_or(view, "byteOffset", 0);
    if (view_begin > bytes.size() || length > bytes.size() - view_begin) {
      reject(fmt::format("its buffer view ends after the {} bytes of its buffer", bytes.size()));
    }
    result.data = bytes.data() + view_begin + begin;
    return result;
  }

  std::string_view buffer(std::size_t index) {
    const auto known = buffers_.find(index);
    if (known != buffers_.end()) return known->second;
    const Json& description = item("buffers", index);
    if (!description.contains("uri")) return binary_;
    return buffers_.emplace(index, load_uri(description.at("uri").get<std::string>()))
        .first->second;
  }

  [[nodiscard]] std::string load_uri(const std::string& uri) const {
    if (uri.starts_with("data:")) {
      const std::size_t comma = uri.find(',');
      const std::string head = uri.substr(0, comma);
      std::optional<std::string> bytes;
      if (comma != std::string::npos && head.ends_with(";base64")) {
        bytes = decode_base64(std::string_view(uri).substr(comma + 1));
      }
      if (!bytes) fail("a buffer within the file is not valid base64");
      return *std::move(bytes);
    }
    if (uri.find(':') != std::string::npos || uri.starts_with('/')) {
      fail("a buffer is at " + in_quotes(uri) + "; expected a file beside this one");
    }
    if (!source_.folder) {
      fail("a buffer is in another file, " + in_quotes(uri) + "; give one GLB file instead");
    }
    return load(*source_.folder / percent_decoded(uri)).bytes;
  }

  const Source& source_;
  std::string_view binary_;
  Json document_;
  std::map<std::size_t, std::string> buffers_;
  Geometry geometry_;
};

}  // namespace

Geometry read_gltf(const Source& source) {
  try {
    Geometry geometry = GltfReader(source, split(source)).read();
    require_finite(source.name, geometry.cloud.points);
    return geometry;
  } catch (const Json::exception& error) {
    // "[json.exception.type_error.302] type must be …": the bracket is of no use to a reader.
    const std::string_view what = error.what();
    fail(source.name, "not a valid glTF 2.0 file: " +
                          std::string(what.substr(std::min(what.find("] ") + 2, what.size()))));
  }
}

}  // namespace morsel::io
