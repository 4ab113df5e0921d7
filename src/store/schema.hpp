// The tables of a database and how older ones become newer.
#pragma once

#include "store/connection.hpp"

namespace morsel::store {

/// The version of the tables that this program reads and writes.
inline constexpr int kSchemaVersion = 3;

/// What tells a database of morsel's from any other SQLite file, and its locks in PostgreSQL from
/// any other.
inline constexpr int kApplicationId = 0x4d72736c;  // "Mrsl"

extern const Schema kSqliteSchema;
extern const Schema kPostgresSchema;

/// Throws Error(kInput) unless the tables can be read as they are, or migrated. Returns their
/// version; 0 where there are none.
int check_version(Connection& connection);

/// Brings the tables to kSchemaVersion, all or nothing; does nothing when they are.
void migrate(Connection& connection);

}  // namespace morsel::store
