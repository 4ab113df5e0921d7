#include "store/sqlite.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <chrono>
#include <morsel/error.hpp>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "io/source.hpp"
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
void use_write_ahead_log(SQLite::Database& database) {
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

// Throws what SQLite said as morsel::Error about the database of that name. It repeats what stands
// in damaged tables.
[[noreturn]] void rethrow(const std::string& name, const SQLite::Exception& error) {
  const auto [code, reason] = meaning_of(error.getErrorCode());
  throw Error(code, fmt::format("{}: {} (SQLite: {}, {})", name, reason, io::escaped(error.what()),
                                error.getExtendedErrorCode()));
}

// Calls work(); SQLite's exceptions come out as morsel::Error.
template <class Work>
decltype(auto) guarded(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const SQLite::Exception& error) {
    rethrow(name, error);
  }
}

class SqliteRows final : public Rows {
 public:
  SqliteRows(SQLite::Database& database, const std::string& statement,
             std::initializer_list<Value> parameters, const std::string& name)
      : name_(name), statement_(database, statement) {
    int index = 0;
    for (const Value& value : parameters) bind(++index, value);
  }

  bool next() override {
    return guarded(name_, [&] { return statement_.executeStep(); });
  }
  [[nodiscard]] std::int64_t integer(int column) const override {
    return guarded(name_, [&] { return statement_.getColumn(column).getInt64(); });
  }
  [[nodiscard]] std::string bytes(int column) const override {
    return guarded(name_, [&] { return statement_.getColumn(column).getString(); });
  }

 private:
  void bind(int index, const Value& value) {
    if (const auto* number = std::get_if<std::int64_t>(&value)) {
      statement_.bind(index, *number);
    } else if (const auto* text = std::get_if<std::string_view>(&value)) {
      statement_.bind(index, std::string(*text));
    } else {
      const std::string_view bytes = std::get<Blob>(value).bytes;
      statement_.bind(index, bytes.data(), static_cast<int>(bytes.size()));
    }
  }

  const std::string& name_;
  mutable SQLite::Statement statement_;  // its getColumn() is not const
};

class Sqlite final : public Connection {
 public:
  Sqlite(const fs::path& file, SQLite::Database database)
      : Connection(file.string()), file_(file), database_(std::move(database)) {}

  void use_log() { use_write_ahead_log(database_); }

  std::unique_ptr<Rows> query(const std::string& statement,
                              std::initializer_list<Value> parameters) override {
    return guarded(name(), [&]() -> std::unique_ptr<Rows> {
      return std::make_unique<SqliteRows>(database_, statement, parameters, name());
    });
  }
  void run_script(const std::string& statements) override {
    guarded(name(), [&] { database_.exec(statements); });
  }

  void begin(Mode mode) override {
    run_script(mode == Mode::kWrite ? "BEGIN IMMEDIATE" : "BEGIN DEFERRED");
  }
  void commit() override { run_script("COMMIT"); }
  void roll_back() noexcept override { database_.tryExec("ROLLBACK"); }

  [[nodiscard]] const Schema& schema() const override { return kSqliteSchema; }
  int version() override {
    // In one statement: another process may just be making the tables.
    const auto rows = query(
        "SELECT application_id, user_version, (SELECT count(*) FROM sqlite_schema) "
        "FROM pragma_application_id, pragma_user_version",
        {});
    rows->next();
    const std::int64_t application = rows->integer(0);
    const std::int64_t version = rows->integer(1);
    const bool has_tables = rows->integer(2) > 0;
    if (application != kApplicationId && (has_tables || application != 0 || version != 0)) {
      throw Error(ErrorCode::kInput, name() +
                                         ": is an SQLite file, but not a database of morsel; "
                                         "name another");
    }
    return static_cast<int>(version);
  }
  void set_version(int version) override {
    run_script(fmt::format("PRAGMA user_version = {}; PRAGMA application_id = {}", version,
                           kApplicationId));
  }

  [[nodiscard]] fs::path block_prefix() const override { return file_; }
  void rebuild_indices() override { run_script("REINDEX"); }
  std::vector<std::string> storage_findings(int most) override {
    std::vector<std::string> findings;
    const auto rows = query(fmt::format("PRAGMA integrity_check({})", most), {});
    while (rows->next()) {
      if (const std::string text = rows->bytes(0); text != "ok") {
        findings.push_back(name() + ": " + text);
      }
    }
    return findings;
  }

 private:
  fs::path file_;
  SQLite::Database database_;
};

}  // namespace

std::unique_ptr<Connection> open_sqlite(const fs::path& file, Access access) {
  check_place(file, access);
  return guarded(file.string(), [&]() -> std::unique_ptr<Connection> {
    SQLite::Database database = open_file(file, access);
    database.exec(
        "PRAGMA foreign_keys = ON; PRAGMA trusted_schema = OFF;"
        "PRAGMA cell_size_check = ON; PRAGMA synchronous = FULL");
    if (access == Access::kRead) {
      database.exec("PRAGMA query_only = ON");
      return std::make_unique<Sqlite>(file, std::move(database));
    }
    const bool is_new = database.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
    // Rows are of some thousand bytes each; larger pages would stay half empty.
    if (is_new) database.exec("PRAGMA page_size = 1024");
    auto connection = std::make_unique<Sqlite>(file, std::move(database));
    // Before anything in the file is changed.
    if (check_version(*connection) > 0 || access == Access::kCreate) connection->use_log();
    return connection;
  });
}

}  // namespace morsel::store
