// The tables of a database and how older ones become newer.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>

namespace morsel::store {

/// What tells a database of morsel's from any other SQLite file.
inline constexpr int kApplicationId = 0x4d72736c;  // "Mrsl"

/// Throws Error(kInput) naming `file` unless its tables can be read as they are, or migrated.
/// Returns their version; 0 for a file without tables.
[[nodiscard]] int check_version(SQLite::Database& database, const std::filesystem::path& file);

/// Brings the tables to kSchemaVersion, all or nothing; does nothing when they are.
void migrate(SQLite::Database& database, const std::filesystem::path& file);

}  // namespace morsel::store
