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

namespace fs = std::filesystem;
using Json = nlohmann::json;

[[noreturn]] void fail(const fs::path& file, const std::string& row, const std::string& reason) {
  throw Error(ErrorCode::kInput, fmt::format("{}: {}: {}; restore it from an export or a copy",
                                             file.string(), row, reason));
}

std::string tags_text(const std::vector<std::string>& tags) { return Json(tags).dump(); }

std::vector<std::string> tags_of(const std::string& text, const fs::path& file,
                                 const std::string& row) {
  const Json json = Json::parse(text, nullptr, false);
  const bool strings =
      json.is_array() &&
      std::all_of(json.begin(), json.end(), [](const Json& tag) { return tag.is_string(); });
  if (!strings) fail(file, row, "its tags cannot be read");
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

void bind_blob(SQLite::Statement& statement, int index, const std::string& bytes) {
  statement.bindNoCopy(index, bytes.data(), static_cast<int>(bytes.size()));
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

void check_text(const char* what, const std::string& text, std::size_t least) {
  constexpr std::size_t kMost = 1024;
  const bool control = std::any_of(text.begin(), text.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (text.size() < least || text.size() > kMost || control || !is_utf8(text)) {
    throw Error(ErrorCode::kUsage,
                fmt::format("{} {} cannot be stored; it must be {} to {} bytes of UTF-8 without "
                            "control characters",
                            what, io::in_quotes(text), least, kMost));
  }
}

void bind_shape(SQLite::Statement& statement, const ShapeInfo& info, std::int64_t signature) {
  statement.bind(1, info.name);
  statement.bind(2, info.class_name);
  statement.bind(3, tags_text(info.tags));
  statement.bind(4, info.source);
  statement.bind(5, signature);
  statement.bind(6, checksum_of(info, signature));
}

void update_shape(SQLite::Database& database, std::int64_t id, const ShapeInfo& info,
                  std::int64_t signature) {
  SQLite::Statement statement(database,
                              "UPDATE shapes SET name = ?, class = ?, tags = ?, source = ?, "
                              "signature = ?, checksum = ? WHERE id = ?");
  bind_shape(statement, info, signature);
  statement.bind(7, id);
  statement.exec();
}

void drop_unused_data(SQLite::Database& database, std::int64_t signature) {
  SQLite::Statement statement(database,
                              "DELETE FROM signatures WHERE id = ?1 AND NOT EXISTS "
                              "(SELECT 1 FROM shapes WHERE signature = ?1)");
  statement.bind(1, signature);
  statement.exec();
}

}  // namespace

ShapeRow read_shape(SQLite::Statement& row, const fs::path& file) {
  ShapeRow shape;
  shape.id = row.getColumn(0).getInt64();
  shape.info.name = row.getColumn(1).getString();
  const std::string place = "shape " + io::in_quotes(shape.info.name);
  shape.info.class_name = row.getColumn(2).getString();
  shape.info.tags = tags_of(row.getColumn(3).getString(), file, place);
  shape.info.source = row.getColumn(4).getString();
  shape.signature = row.getColumn(5).getInt64();
  if (row.getColumn(6).getInt64() != checksum_of(shape.info, shape.signature)) {
    fail(file, place, "the row does not have its checksum");
  }
  return shape;
}

Signature read_signature(const SQLite::Column& column, const std::string& name,
                         const fs::path& file) {
  const std::string bytes = column.getString();
  const std::string place = fmt::format("{}: shape {}", file.string(), io::in_quotes(name));
  return decode(std::as_bytes(std::span(bytes)), place);
}

ShapeData read_data(SQLite::Statement& row, const fs::path& file, int first_column) {
  const auto column = [&](int index) { return row.getColumn(first_column + index); };
  const std::string place = fmt::format("signature {}", column(0).getInt64());
  ShapeData data;
  data.content = column(1).getString();
  data.options = column(2).getString();
  data.points = static_cast<std::uint64_t>(column(3).getInt64());
  DataBytes bytes{column(4).getString(), column(5).getString()};
  if (column(6).getInt64() != checksum_of(data, bytes)) {
    fail(file, place, "the row does not have its checksum");
  }
  const std::string name = file.string() + ": " + place;
  data.signature = decode(std::as_bytes(std::span(bytes.signature)), name);
  data.sketch = decode_sketch(std::move(bytes.sketch), name);
  return data;
}

void throw_missing(const std::string& name, const fs::path& file) {
  throw Error(ErrorCode::kInput, fmt::format("{}: {} is not in the database; list shows the names",
                                             file.string(), io::in_quotes(name)));
}

std::optional<ShapeRow> find_shape(SQLite::Database& database, const std::string& name,
                                   const fs::path& file) {
  SQLite::Statement statement(database,
                              fmt::format("SELECT {} FROM shapes WHERE name = ?", kShapeColumns));
  statement.bind(1, name);
  if (!statement.executeStep()) return std::nullopt;
  return read_shape(statement, file);
}

std::vector<ShapeRow> all_shapes(SQLite::Database& database, const fs::path& file) {
  SQLite::Statement statement(database,
                              fmt::format("SELECT {} FROM shapes ORDER BY name", kShapeColumns));
  std::vector<ShapeRow> rows;
  while (statement.executeStep()) rows.push_back(read_shape(statement, file));
  return rows;
}

std::optional<std::int64_t> find_data(SQLite::Database& database, const std::string& content) {
  SQLite::Statement statement(database, "SELECT id FROM signatures WHERE content = ?");
  statement.bind(1, content);
  if (!statement.executeStep()) return std::nullopt;
  return statement.getColumn(0).getInt64();
}

std::int64_t insert_data(SQLite::Database& database, const ShapeData& data) {
  if (const auto known = find_data(database, data.content)) return *known;
  const DataBytes bytes = bytes_of(data);
  SQLite::Statement statement(database,
                              "INSERT INTO signatures (content, options, points, signature, "
                              "sketch, checksum) VALUES (?, ?, ?, ?, ?, ?)");
  statement.bind(1, data.content);
  statement.bind(2, data.options);
  statement.bind(3, static_cast<std::int64_t>(data.points));
  bind_blob(statement, 4, bytes.signature);
  bind_blob(statement, 5, bytes.sketch);
  statement.bind(6, checksum_of(data, bytes));
  statement.exec();
  return database.getLastInsertRowid();
}

Change write_shape(SQLite::Database& database, const ShapeInfo& info, std::int64_t signature,
                   const fs::path& file) {
  const std::optional<ShapeRow> old = find_shape(database, info.name, file);
  if (!old) {
    SQLite::Statement statement(database,
                                "INSERT INTO shapes (name, class, tags, source, signature, "
                                "checksum) VALUES (?, ?, ?, ?, ?, ?)");
    bind_shape(statement, info, signature);
    statement.exec();
    return Change::kAdded;
  }
  if (old->info == info && old->signature == signature) return Change::kUnchanged;
  update_shape(database, old->id, info, signature);
  if (old->signature != signature) drop_unused_data(database, old->signature);
  return Change::kReplaced;
}

void relabel_shape(SQLite::Database& database, const ShapeRow& row, const ShapeInfo& info) {
  update_shape(database, row.id, info, row.signature);
}

void delete_shape(SQLite::Database& database, const ShapeRow& row) {
  SQLite::Statement statement(database, "DELETE FROM shapes WHERE id = ?");
  statement.bind(1, row.id);
  statement.exec();
  drop_unused_data(database, row.signature);
}

ShapeInfo checked(ShapeInfo info) {
  check_text("the name", info.name, 1);
  check_text("the class", info.class_name, 0);
  for (const std::string& tag : info.tags) check_text("the tag", tag, 1);
  std::sort(info.tags.begin(), info.tags.end());
  info.tags.erase(std::unique(info.tags.begin(), info.tags.end()), info.tags.end());
  return info;
}

}  // namespace morsel::store
