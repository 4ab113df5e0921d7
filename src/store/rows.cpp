#include "store/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <morsel/error.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "io/source.hpp"
#include "store/hash.hpp"

namespace morsel::store {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostTextBytes = 1024;

[[noreturn]] void fail(const std::string& place, const std::string& row,
                       const std::string& reason) {
  throw Error(ErrorCode::kInput,
              fmt::format("{}: {}: {}; restore it from an export or a copy", place, row, reason));
}

std::string tags_text(const std::vector<std::string>& tags) { return Json(tags).dump(); }

std::vector<std::string> tags_of(const std::string& text, const std::string& place,
                                 const std::string& row) {
  const Json json = Json::parse(text, nullptr, false);
  const bool strings =
      json.is_array() &&
      std::all_of(json.begin(), json.end(), [](const Json& tag) { return tag.is_string(); });
  if (!strings) fail(place, row, "its tags cannot be read");
  return json.get<std::vector<std::string>>();
}

std::int64_t checksum_of(const ShapeInfo& info, std::int64_t signature) {
  Fingerprint sum;
  sum.add(info.name).add(info.class_name).add(tags_text(info.tags)).add(info.source);
  return sum.add(signature).checksum_64();
}

// The columns that a signature's row holds as bytes.
struct DataBytes {
  std::string signature;
  std::string sketch;
};

std::int64_t checksum_of(const ShapeData& data, const DataBytes& bytes) {
  Fingerprint sum;
  sum.add(data.content).add(data.options).add(static_cast<std::int64_t>(data.points));
  return sum.add(bytes.signature).add(bytes.sketch).checksum_64();
}

DataBytes bytes_of(const ShapeData& data) {
  const std::vector<std::byte> signature = encode(data.signature);
  return {{reinterpret_cast<const char*>(signature.data()), signature.size()},
          encode_sketch(data.sketch)};
}

std::string signature_name(const Rows& row, int first_column) {
  return fmt::format("signature {}", row.integer(first_column));
}

// What kDataColumns hold, with its checksum; what is not bytes goes to `data`.
DataBytes read_bytes(const Rows& row, const std::string& place, int first_column, ShapeData& data) {
  data.content = row.bytes(first_column + 1);
  data.options = row.bytes(first_column + 2);
  data.points = static_cast<std::uint64_t>(row.integer(first_column + 3));
  DataBytes bytes{row.bytes(first_column + 4), row.bytes(first_column + 5)};
  if (row.integer(first_column + 6) != checksum_of(data, bytes)) {
    fail(place, signature_name(row, first_column), "the row does not have its checksum");
  }
  return bytes;
}

// Names must be UTF-8: they go into JSON.
bool is_utf8(const std::string& text) {
  try {
    (void)Json(text).dump();
    return true;
  } catch (const Json::type_error&) {
    return false;
  }
}

bool can_be_text(const std::string& text, std::size_t least) {
  const bool control = std::any_of(text.begin(), text.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  return text.size() >= least && text.size() <= kMostTextBytes && !control && is_utf8(text);
}

void check_text(const char* what, const std::string& text, std::size_t least) {
  if (!can_be_text(text, least)) {
    throw Error(ErrorCode::kUsage,
                fmt::format("{} {} cannot be stored; it must be {} to {} bytes of UTF-8 without "
                            "control characters",
                            what, io::in_quotes(text), least, kMostTextBytes));
  }
}

void update_shape(Connection& connection, std::int64_t id, const ShapeInfo& info,
                  std::int64_t signature) {
  connection.run(
      "UPDATE shapes SET name = ?1, class = ?2, tags = ?3, source = ?4, signature = ?5, "
      "checksum = ?6 WHERE id = ?7",
      {info.name, info.class_name, tags_text(info.tags), info.source, signature,
       checksum_of(info, signature), id});
}

void drop_unused_data(Connection& connection, std::int64_t signature) {
  connection.run(
      "DELETE FROM signatures WHERE id = ?1 AND NOT EXISTS "
      "(SELECT 1 FROM shapes WHERE signature = ?1)",
      {signature});
}

}  // namespace

ShapeRow read_shape(const Rows& row, const std::string& place) {
  ShapeRow shape;
  shape.id = row.integer(0);
  shape.info.name = row.bytes(1);
  const std::string which = "shape " + io::in_quotes(shape.info.name);
  shape.info.class_name = row.bytes(2);
  shape.info.tags = tags_of(row.bytes(3), place, which);
  shape.info.source = row.bytes(4);
  shape.signature = row.integer(5);
  shape.checksum = row.integer(6);
  if (shape.checksum != checksum_of(shape.info, shape.signature)) {
    fail(place, which, "the row does not have its checksum");
  }
  return shape;
}

ShapeData read_data(const Rows& row, const std::string& place, int first_column) {
  ShapeData data;
  DataBytes bytes = read_bytes(row, place, first_column, data);
  const std::string name = place + ": " + signature_name(row, first_column);
  data.signature = decode(std::as_bytes(std::span(bytes.signature)), name);
  data.sketch = decode_sketch(std::move(bytes.sketch), name);
  return data;
}

void throw_missing(const std::string& name, const std::string& place) {
  throw Error(ErrorCode::kInput, fmt::format("{}: {} is not in the database; list shows the names",
                                             place, io::in_quotes(name)));
}

std::optional<ShapeRow> find_shape(Connection& connection, const std::string& name) {
  if (!is_utf8(name)) return std::nullopt;
  const auto rows =
      connection.query(fmt::format("SELECT {} FROM shapes WHERE name = ?1", kShapeColumns), {name});
  if (!rows->next()) return std::nullopt;
  return read_shape(*rows, connection.name());
}

void each_signature(Connection& connection, const std::string& rest,
                    std::initializer_list<Value> parameters,
                    const std::function<void(ShapeRow, Signature)>& visit) {
  const auto rows =
      connection.query(fmt::format("SELECT {}, signatures.signature FROM shapes JOIN signatures ON "
                                   "signatures.id = shapes.signature {}",
                                   kShapeColumns, rest),
                       parameters);
  while (rows->next()) {
    ShapeRow row = read_shape(*rows, connection.name());
    const std::string bytes = rows->bytes(7);
    const std::string which =
        fmt::format("{}: shape {}", connection.name(), io::in_quotes(row.info.name));
    Signature signature = decode(std::as_bytes(std::span(bytes)), which);
    visit(std::move(row), std::move(signature));
  }
}

std::vector<std::pair<ShapeRow, std::string>> all_sketches(Connection& connection) {
  constexpr int kDataAt = 7;
  const auto rows = connection.query(
      fmt::format("SELECT {}, {} FROM shapes JOIN signatures ON signatures.id = shapes.signature "
                  "ORDER BY name",
                  kShapeColumns, kDataColumns));
  std::vector<std::pair<ShapeRow, std::string>> sketches;
  while (rows->next()) {
    ShapeData data;
    DataBytes bytes = read_bytes(*rows, connection.name(), kDataAt, data);
    sketches.emplace_back(read_shape(*rows, connection.name()), std::move(bytes.sketch));
  }
  return sketches;
}

std::vector<ShapeRow> all_shapes(Connection& connection) {
  const auto rows =
      connection.query(fmt::format("SELECT {} FROM shapes ORDER BY name", kShapeColumns));
  std::vector<ShapeRow> shapes;
  while (rows->next()) shapes.push_back(read_shape(*rows, connection.name()));
  return shapes;
}

std::optional<std::int64_t> find_data(Connection& connection, const std::string& content) {
  return connection.integer("SELECT id FROM signatures WHERE content = ?1", {content});
}

std::int64_t insert_data(Connection& connection, const ShapeData& data) {
  if (const auto known = find_data(connection, data.content)) return *known;
  const DataBytes bytes = bytes_of(data);
  const std::int64_t checksum = checksum_of(data, bytes);
  // Rows are appended, but how far behind the last one depends on what they hold. So the rows of
  // shapes that refer to them, their checksums and the digest of these differ wherever contents do,
  // also between two databases with the same names, and a search block of the one is not of the
  // other.
  constexpr std::int64_t kMostGap = 0xffffffff;
  return connection
      .integer(fmt::format("INSERT INTO signatures (id, content, options, points, signature, "
                           "sketch, checksum) {}VALUES ((SELECT COALESCE(max(id), 0) FROM "
                           "signatures) + 1 + ?7, ?1, ?2, ?3, ?4, ?5, ?6) RETURNING id",
                           connection.schema().own_ids),
               {data.content, data.options, static_cast<std::int64_t>(data.points),
                Blob(bytes.signature), Blob(bytes.sketch), checksum, checksum & kMostGap})
      .value();
}

Change write_shape(Connection& connection, const ShapeInfo& info, std::int64_t signature) {
  connection.run("DELETE FROM failures WHERE name = ?1", {info.name});
  const std::optional<ShapeRow> old = find_shape(connection, info.name);
  if (!old) {
    connection.run(
        "INSERT INTO shapes (name, class, tags, source, signature, checksum) "
        "VALUES (?1, ?2, ?3, ?4, ?5, ?6)",
        {info.name, info.class_name, tags_text(info.tags), info.source, signature,
         checksum_of(info, signature)});
    return Change::kAdded;
  }
  if (old->info == info && old->signature == signature) return Change::kUnchanged;
  update_shape(connection, old->id, info, signature);
  if (old->signature != signature) drop_unused_data(connection, old->signature);
  return Change::kReplaced;
}

void relabel_shape(Connection& connection, const ShapeRow& row, const ShapeInfo& info) {
  update_shape(connection, row.id, info, row.signature);
}

void delete_shape(Connection& connection, const ShapeRow& row) {
  connection.run("DELETE FROM shapes WHERE id = ?1", {row.id});
  drop_unused_data(connection, row.signature);
}

bool can_be_name(const std::string& text) { return can_be_text(text, 1); }

ShapeInfo checked(ShapeInfo info) {
  check_text("the name", info.name, 1);
  check_text("the class", info.class_name, 0);
  for (const std::string& tag : info.tags) check_text("the tag", tag, 1);
  std::sort(info.tags.begin(), info.tags.end());
  info.tags.erase(std::unique(info.tags.begin(), info.tags.end()), info.tags.end());
  return info;
}

}  // namespace morsel::store
