// Shapes and signatures as rows of the tables, each with its checksum.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <filesystem>
#include <morsel/database.hpp>
#include <optional>
#include <string>
#include <vector>

namespace morsel::store {

/// A row of the table `shapes`.
struct ShapeRow {
  std::int64_t id = 0;
  ShapeInfo info;
  std::int64_t signature = 0;
};

/// Columns of a query whose rows read_shape() takes.
inline constexpr const char* kShapeColumns =
    "shapes.id, name, class, tags, source, shapes.signature, shapes.checksum";
/// Columns of a query whose rows read_data() takes.
inline constexpr const char* kDataColumns =
    "signatures.id, content, options, points, signatures.signature, sketch, "
    "signatures.checksum";

/// Throw Error(kInput) naming the database `file` and the row that is damaged.
[[nodiscard]] ShapeRow read_shape(SQLite::Statement& row, const std::filesystem::path& file);
[[nodiscard]] ShapeData read_data(SQLite::Statement& row, const std::filesystem::path& file,
                                  int first_column = 0);
[[nodiscard]] Signature read_signature(const SQLite::Column& column, const std::string& name,
                                       const std::filesystem::path& file);

/// Says that there is no shape of that name.
[[noreturn]] void throw_missing(const std::string& name, const std::filesystem::path& file);

[[nodiscard]] std::optional<ShapeRow> find_shape(SQLite::Database& database,
                                                 const std::string& name,
                                                 const std::filesystem::path& file);
/// All shapes by name.
[[nodiscard]] std::vector<ShapeRow> all_shapes(SQLite::Database& database,
                                               const std::filesystem::path& file);

[[nodiscard]] std::optional<std::int64_t> find_data(SQLite::Database& database,
                                                    const std::string& content);
/// Returns the row's id; that of the row of that content where there is one.
std::int64_t insert_data(SQLite::Database& database, const ShapeData& data);

/// Adds a shape or replaces the one of that name. Within the caller's transaction.
Change write_shape(SQLite::Database& database, const ShapeInfo& info, std::int64_t signature,
                   const std::filesystem::path& file);
/// Gives the row another name, class, tags and source.
void relabel_shape(SQLite::Database& database, const ShapeRow& row, const ShapeInfo& info);
/// Drops the shape, and its signature when no other shape has it.
void delete_shape(SQLite::Database& database, const ShapeRow& row);

/// Throws Error(kUsage) when a shape cannot be stored under such a name, class and tags. Returns it
/// with the tags in order.
[[nodiscard]] ShapeInfo checked(ShapeInfo info);

}  // namespace morsel::store
