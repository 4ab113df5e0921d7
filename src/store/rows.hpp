// Shapes and signatures as rows of the tables, each with its checksum.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <morsel/database.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "store/connection.hpp"

namespace morsel::store {

/// A row of the table `shapes`.
struct ShapeRow {
  std::int64_t id = 0;
  ShapeInfo info;
  std::int64_t signature = 0;
  std::int64_t checksum = 0;
};

/// Columns of a query whose rows read_shape() takes.
inline constexpr const char* kShapeColumns =
    "shapes.id, name, class, tags, source, shapes.signature, shapes.checksum";
/// Columns of a query whose rows read_data() takes.
inline constexpr const char* kDataColumns =
    "signatures.id, content, options, points, signatures.signature, sketch, "
    "signatures.checksum";

/// The rest of a query, from FROM on, for what has lost its other half.
inline constexpr const char* kShapesWithoutSignature =
    "FROM shapes WHERE NOT EXISTS (SELECT 1 FROM signatures WHERE signatures.id = "
    "shapes.signature)";
inline constexpr const char* kSignaturesWithoutShape =
    "FROM signatures WHERE NOT EXISTS (SELECT 1 FROM shapes WHERE shapes.signature = "
    "signatures.id)";

/// Throw Error(kInput) naming the database `place` and the row that is damaged.
[[nodiscard]] ShapeRow read_shape(const Rows& row, const std::string& place);
[[nodiscard]] ShapeData read_data(const Rows& row, const std::string& place, int first_column = 0);

/// Says that there is no shape of that name.
[[noreturn]] void throw_missing(const std::string& name, const std::string& place);

[[nodiscard]] std::optional<ShapeRow> find_shape(Connection& connection, const std::string& name);
/// Calls visit(row, signature) for shapes with their signatures, as `rest`, what follows FROM in
/// the statement, chooses and orders them.
void each_signature(Connection& connection, const std::string& rest,
                    std::initializer_list<Value> parameters,
                    const std::function<void(ShapeRow, Signature)>& visit);
/// All shapes by name, each with the bytes of its sketch.
[[nodiscard]] std::vector<std::pair<ShapeRow, std::string>> all_sketches(Connection& connection);
/// All shapes by name.
[[nodiscard]] std::vector<ShapeRow> all_shapes(Connection& connection);

[[nodiscard]] std::optional<std::int64_t> find_data(Connection& connection,
                                                    const std::string& content);
/// Returns the row's id; that of the row of that content where there is one.
std::int64_t insert_data(Connection& connection, const ShapeData& data);

/// Adds a shape or replaces the one of that name. Within the caller's transaction.
Change write_shape(Connection& connection, const ShapeInfo& info, std::int64_t signature);
/// Gives the row another name, class, tags and source.
void relabel_shape(Connection& connection, const ShapeRow& row, const ShapeInfo& info);
/// Drops the shape, and its signature when no other shape has it.
void delete_shape(Connection& connection, const ShapeRow& row);

/// Throws Error(kUsage) when a shape cannot be stored under such a name, class and tags. Returns it
/// with the tags in order.
[[nodiscard]] ShapeInfo checked(ShapeInfo info);
/// Whether a shape can have that name.
[[nodiscard]] bool can_be_name(const std::string& text);

}  // namespace morsel::store
