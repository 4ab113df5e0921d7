// A database as JSON lines and back.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "base/base64.hpp"
#include "base/whole_number.hpp"
#include "store/rows.hpp"
#include "store/state.hpp"

namespace morsel {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kHeaderField = "morsel_shapes";
constexpr int kVersion = 2;  // of the lines

std::string line_of(const ShapeInfo& info, const ShapeData& data) {
  Json json;
  json["name"] = info.name;
  json["class"] = info.class_name;
  json["tags"] = info.tags;
  json["source"] = info.source;
  json["content"] = data.content;
  json["options"] = data.options;
  json["points"] = data.points;
  json["signature"] = Json::parse(to_json(data.signature));
  json["sketch"] = encode_base64(encode_sketch(data.sketch));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

[[noreturn]] void fail(const std::string& place, const std::string& reason) {
  throw Error(ErrorCode::kInput, place + ": " + reason);
}

Json parse_object(const std::string& line, const std::string& place) {
  Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) fail(place, "is not a JSON object; expected a line that export wrote");
  return json;
}

const Json& present(const Json& json, const char* name, const std::string& place) {
  const auto at = json.find(name);
  if (at == json.end()) fail(place, fmt::format("lacks the field \"{}\"", name));
  return *at;
}

template <class Value>
Value field(const Json& json, const char* name, const std::string& place) {
  const Json& value = present(json, name, place);
  try {
    return value.get<Value>();
  } catch (const Json::exception&) {
    fail(place, fmt::format("the field \"{}\" is of another type than export writes", name));
  }
}

template <class Integer>
Integer number_field(const Json& json, const char* name, const std::string& place) {
  if (const auto number = whole_number<Integer>(present(json, name, place))) return *number;
  fail(place, fmt::format("the field \"{}\" is not a whole number from 0 to {}", name,
                          std::numeric_limits<Integer>::max()));
}

std::string bytes_field(const Json& json, const char* name, const std::string& place) {
  const auto bytes = decode_base64(field<std::string>(json, name, place));
  if (!bytes) fail(place, fmt::format("the field \"{}\" is not base64", name));
  return *bytes;
}

void check_header(const std::string& line, const std::string& place) {
  const int version = number_field<int>(parse_object(line, place), kHeaderField, place);
  if (version == kVersion) return;
  fail(place,
       fmt::format("version {} of the lines; this program knows version {}", version, kVersion));
}

StoredShape shape_of(const std::string& line, const std::string& place) {
  const Json json = parse_object(line, place);
  StoredShape shape;
  shape.info.name = field<std::string>(json, "name", place);
  shape.info.class_name = field<std::string>(json, "class", place);
  shape.info.tags = field<std::vector<std::string>>(json, "tags", place);
  shape.info.source = field<std::string>(json, "source", place);
  shape.data.content = field<std::string>(json, "content", place);
  const std::string& content = shape.data.content;
  if (content.size() != 32 || content.find_first_not_of("0123456789abcdef") != std::string::npos) {
    fail(place, "the field \"content\" is not 32 hexadecimal digits");
  }
  shape.data.options = field<std::string>(json, "options", place);
  shape.data.points = static_cast<std::uint64_t>(
      number_field<std::int64_t>(json, "points", place));  // as rows hold it
  shape.data.signature = signature_from_json(field<Json>(json, "signature", place).dump(), place);
  shape.data.sketch = decode_sketch(bytes_field(json, "sketch", place), place + ": sketch");
  return shape;
}

}  // namespace

void Database::export_lines(std::ostream& stream) const {
  state_->once(State::Mode::kRead, [&](store::Connection& connection) {
    const auto rows =
        connection.query(fmt::format("SELECT {}, {} FROM shapes JOIN signatures ON "
                                     "signatures.id = shapes.signature ORDER BY name",
                                     store::kShapeColumns, store::kDataColumns));
    stream << Json{{kHeaderField, kVersion}}.dump() << '\n';
    while (rows->next()) {
      const ShapeInfo info = store::read_shape(*rows, connection.name()).info;
      stream << line_of(info, store::read_data(*rows, connection.name(), 7)) << '\n';
      if (!stream) throw Error(ErrorCode::kOutput, "the export cannot be written");
    }
    return true;
  });
}

std::size_t Database::import_lines(std::istream& stream, const std::string& name) {
  return state_->once(State::Mode::kWrite, [&](store::Connection& connection) {
    std::size_t number = 0;
    std::size_t count = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      const std::string place = fmt::format("{}:{}", name, number);
      if (number == 1) {
        check_header(line, place);
        continue;
      }
      const StoredShape shape = shape_of(line, place);
      const std::int64_t signature = store::insert_data(connection, shape.data);
      store::write_shape(connection, store::checked(shape.info), signature);
      ++count;
    }
    if (stream.bad()) throw Error(ErrorCode::kInput, name + ": cannot read");
    if (number == 0) fail(name, "is empty; expected the lines that export wrote");
    return count;
  });
}

}  // namespace morsel
