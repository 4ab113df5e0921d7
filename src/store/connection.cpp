#include "store/connection.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <chrono>
#include <morsel/error.hpp>
#include <string_view>
#include <system_error>
#include <thread>

#include "store/schema.hpp"

namespace morsel::store {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kPatience = std::chrono::minutes(1);

// A path as SQLite's URI, whatever characters it holds.
std::string uri_of(const fs::path& file) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789/._-";
  std::string uri = "file:";
  for (const char c : file.string()) {
    if (kPlain.find(c) != std::string_view::npos) {
      uri += c;
    } else {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return uri;
}

void check_place(const fs::path& file, Access access) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  const auto fail = [&](ErrorCode code, const std::string& reason) {
    throw Error(code, file.string() + ": " + reason);
  };
  if (fs::is_directory(status)) fail(ErrorCode::kInput, "is a directory; name a database file");
  if (fs::exists(status)) {
    if (!fs::is_regular_file(status)) fail(ErrorCode::kInput, "is not a regular file");
    return;
  }
  if (access != Access::kCreate) {
    fail(ErrorCode::kInput, "there is no such database; index shapes into it to make it");
  }
  const fs::path folder = fs::absolute(file).parent_path();
  if (!fs::is_directory(folder, error)) {
    fail(ErrorCode::kOutput, "the folder " + folder.string() + " does not exist");
  }
}

// Touches the tables, which tells whether the file and its log can be read.
void probe(SQLite::Database& database) {
  (void)database.execAndGet("SELECT count(*) FROM sqlite_schema");
}

// A write-ahead log needs files beside the database, which a read-only folder cannot take. Without
// a log that waits to be merged, the file alone is the whole truth.
SQLite::Database open_immutable(const fs::path& absolute) {
  fs::path log = absolute;
  log += "-wal";
  std::error_code error;
  const auto waiting = fs::file_size(log, error);
  if (!error && waiting > 0) {
    throw Error(ErrorCode::kInput,
                absolute.string() +
                    ": has changes in its log that cannot be read in a read-only folder; open it "
                    "once where the folder can be written");
  }
  return {uri_of(absolute) + "?immutable=1", SQLite::OPEN_READONLY | SQLite::OPEN_URI};
}

SQLite::Database open_file(const fs::path& file, Access access) {
  const fs::path absolute = fs::absolute(file);
  const int create = access == Access::kCreate ? SQLite::OPEN_CREATE : 0;
  SQLite::Database database(absolute.string(), SQLite::OPEN_READWRITE | create);
  database.setBusyTimeout(static_cast<int>(kPatience.count()));
  if (access != Access::kRead) return database;
  try {
    probe(database);
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() != SQLITE_CANTOPEN && error.getErrorCode() != SQLITE_READONLY) throw;
    return open_immutable(absolute);
  }
  return database;
}

// SQLite does not wait for others while it changes the journal mode.
void use_log(SQLite::Database& database) {
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  while (database.execAndGet("PRAGMA journal_mode").getString() != "wal") {
    try {
      database.exec("PRAGMA journal_mode = WAL");
    } catch (const SQLite::Exception& error) {
      const bool busy = error.getErrorCode() == SQLITE_BUSY;
      if (!busy || std::chrono::steady_clock::now() > give_up) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
}

struct Meaning {
  ErrorCode code;
  const char* reason;
};

Meaning meaning_of(int sqlite_code) {
  switch (sqlite_code) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {ErrorCode::kOutput, "another program has kept the database locked for a minute"};
    case SQLITE_FULL:
      return {ErrorCode::kOutput, "cannot write: the disk is full"};
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_CANTOPEN:
      return {ErrorCode::kOutput, "cannot write the database, or a file beside it"};
    case SQLITE_IOERR:
      return {ErrorCode::kOutput, "cannot read or write; the disk may be full"};
    case SQLITE_NOTADB:
      return {ErrorCode::kInput, "is not a database of morsel, or its first bytes are damaged"};
    case SQLITE_NOMEM:
    case SQLITE_TOOBIG:
      return {ErrorCode::kResource, "not enough memory for the database"};
    case SQLITE_CORRUPT:
    case SQLITE_MISMATCH:
    case SQLITE_SCHEMA:
    case SQLITE_CONSTRAINT:
    case SQLITE_ERROR:  // tables or columns that are not there
      return {ErrorCode::kInput, "the database is damaged; restore it from an export or a copy"};
    default:
      return {ErrorCode::kInternal, "the database failed"};
  }
}

}  // namespace

void rethrow(const fs::path& file, const SQLite::Exception& error) {
  const auto [code, reason] = meaning_of(error.getErrorCode());
  throw Error(code, fmt::format("{}: {} (SQLite: {}, {})", file.string(), reason, error.what(),
                                error.getExtendedErrorCode()));
}

SQLite::Database connect(const fs::path& file, Access access) {
  check_place(file, access);
  return guarded(file, [&] {
    SQLite::Database database = open_file(file, access);
    database.exec(
        "PRAGMA foreign_keys = ON; PRAGMA trusted_schema = OFF;"
        "PRAGMA cell_size_check = ON; PRAGMA synchronous = FULL");
    const int version = check_version(database, file);
    if (version == 0 && access != Access::kCreate) {
      throw Error(ErrorCode::kInput,
                  file.string() + ": the file is empty; index shapes into it to make a database");
    }
    // Rows are of some thousand bytes each; larger pages would stay half empty.
    if (version == 0) database.exec("PRAGMA page_size = 1024");
    if (access == Access::kRead) {
      if (version < kSchemaVersion) {
        throw Error(ErrorCode::kInput, file.string() +
                                           ": was written by an older morsel; change anything in "
                                           "it with this program to bring it up to date");
      }
      database.exec("PRAGMA query_only = ON");
      return database;
    }
    use_log(database);
    migrate(database, file);
    return database;
  });
}

std::int64_t state_token(SQLite::Database& database) {
  return database.execAndGet("SELECT token FROM state WHERE id = 1").getInt64();
}

}  // namespace morsel::store
