#include "store/schema.hpp"

#include <fmt/format.h>

#include <array>
#include <morsel/error.hpp>

#include "store/connection.hpp"

namespace morsel::store {
namespace {

// kSteps[0] makes the tables of the oldest version, each further step leads to the next. A
// published step is never changed.
//
// Version 1, with stored thumbnails, was never released. Version 2. A signature is stored once for
// a content; a row's checksum is over its other columns (rows.cpp). `token` takes a random value at
// every change, so that a copy of the signatures can tell whether it is still the current one, also
// after the file was replaced by a backup.
constexpr std::array<const char*, kSchemaVersion - kOldestVersion + 1> kSteps{R"(
CREATE TABLE signatures (
  id INTEGER PRIMARY KEY,
  content TEXT NOT NULL UNIQUE,
  options TEXT NOT NULL,
  points INTEGER NOT NULL,
  signature BLOB NOT NULL,
  sketch BLOB NOT NULL,
  checksum INTEGER NOT NULL
) STRICT;
CREATE TABLE shapes (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,
  class TEXT NOT NULL,
  tags TEXT NOT NULL,
  source TEXT NOT NULL,
  signature INTEGER NOT NULL REFERENCES signatures (id),
  checksum INTEGER NOT NULL
) STRICT;
CREATE INDEX shapes_of_signature ON shapes (signature);
CREATE TABLE state (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  token INTEGER NOT NULL
) STRICT;
INSERT INTO state VALUES (1, random());
CREATE TRIGGER shape_added AFTER INSERT ON shapes BEGIN UPDATE state SET token = random(); END;
CREATE TRIGGER shape_changed AFTER UPDATE ON shapes BEGIN UPDATE state SET token = random(); END;
CREATE TRIGGER shape_removed AFTER DELETE ON shapes BEGIN UPDATE state SET token = random(); END;
CREATE TRIGGER signature_changed AFTER UPDATE ON signatures
  BEGIN UPDATE state SET token = random(); END;
)"};

}  // namespace

int check_version(SQLite::Database& database, const std::filesystem::path& file) {
  const int application = database.execAndGet("PRAGMA application_id").getInt();
  const int version = database.execAndGet("PRAGMA user_version").getInt();
  const bool has_tables = database.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() > 0;
  if (application != kApplicationId && (has_tables || application != 0 || version != 0)) {
    throw Error(ErrorCode::kInput, fmt::format("{}: is an SQLite file, but not a database of "
                                               "morsel; name another",
                                               file.string()));
  }
  if (version > kSchemaVersion) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: was written by a newer morsel (version {} of the tables, this "
                            "program knows {}); update morsel",
                            file.string(), version, kSchemaVersion));
  }
  if (version > 0 && version < kOldestVersion) {
    throw Error(
        ErrorCode::kInput,
        fmt::format("{}: was written by an early state of morsel (version {} of the tables, "
                    "this program knows {}); index its shapes into a new database",
                    file.string(), version, kSchemaVersion));
  }
  return version;
}

void migrate(SQLite::Database& database, const std::filesystem::path& file) {
  if (check_version(database, file) == kSchemaVersion) return;
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  // Another process may have done it while this one waited for its turn.
  const int version = check_version(database, file);
  const int done = version > 0 ? version - kOldestVersion + 1 : 0;
  for (auto step = static_cast<std::size_t>(done); step < kSteps.size(); ++step) {
    database.exec(kSteps[step]);
  }
  database.exec(fmt::format("PRAGMA user_version = {}", kSchemaVersion));
  database.exec(fmt::format("PRAGMA application_id = {}", kApplicationId));
  transaction.commit();
}

}  // namespace morsel::store
