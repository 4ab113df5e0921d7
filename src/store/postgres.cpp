#include "store/postgres.hpp"

#include <fmt/format.h>
#include <libpq-fe.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "io/bytes.hpp"
#include "store/hash.hpp"
#include "store/schema.hpp"

namespace morsel::store {
namespace {

namespace fs = std::filesystem;

struct Finish {
  void operator()(PGconn* connection) const { PQfinish(connection); }
};
using Link = std::unique_ptr<PGconn, Finish>;
struct Clear {
  void operator()(PGresult* result) const { PQclear(result); }
};
using Result = std::unique_ptr<PGresult, Clear>;

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\t', ' ');
  return text;
}

// What the first characters of an SQLSTATE mean.
struct Meaning {
  std::string_view state;
  ErrorCode code;
  const char* reason;
};
constexpr std::array kMeanings{
    Meaning{"53100", ErrorCode::kOutput, "cannot write: the server's disk is full"},
    Meaning{"53", ErrorCode::kResource, "the server has not enough memory"},
    Meaning{"25006", ErrorCode::kOutput, "the server takes no changes, or none from this login"},
    Meaning{"42501", ErrorCode::kOutput, "this login may not do that"},
    Meaning{"55P03", ErrorCode::kOutput,
            "another program has kept the database locked for a minute"},
    Meaning{"22", ErrorCode::kInput, "cannot be stored there"},
    Meaning{"23", ErrorCode::kInput, "the database is damaged; run check"},
    Meaning{"42", ErrorCode::kInput,
            "the database is damaged; restore it from an export or a copy"},
    Meaning{"XX", ErrorCode::kInput,
            "the database is damaged; restore it from an export or a copy"},
};

// The server went away or is about to, which libpq says without a state, or several who wait for
// each other were told to try again.
bool is_lost(const PGconn* connection, std::string_view state) {
  return state.empty() || PQstatus(connection) == CONNECTION_BAD || state.starts_with("08") ||
         state.starts_with("57P") || state.starts_with("40");
}

[[noreturn]] void rethrow(const std::string& name, const PGconn* connection,
                          const PGresult* result) {
  const char* const given = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  const std::string state = given != nullptr ? given : "";
  const char* const primary = PQresultErrorField(result, PG_DIAG_MESSAGE_PRIMARY);
  const std::string said = one_line(primary != nullptr ? primary : PQerrorMessage(connection));
  if (is_lost(connection, state)) {
    throw LostConnection(fmt::format("{}: the connection was lost (PostgreSQL: {})", name, said));
  }
  const auto meaning = std::find_if(kMeanings.begin(), kMeanings.end(), [&](const Meaning& known) {
    return state.starts_with(known.state);
  });
  const bool known = meaning != kMeanings.end();
  throw Error(known ? meaning->code : ErrorCode::kInternal,
              fmt::format("{}: {} (PostgreSQL: {}, {})", name,
                          known ? meaning->reason : "the database failed", said, state));
}

// `?1` is `$1` to PostgreSQL. No statement of ours has a question mark of another meaning.
std::string translated(std::string statement) {
  std::replace(statement.begin(), statement.end(), '?', '$');
  return statement;
}

// Parameters as libpq takes them: numbers as text, texts and bytes as they are.
class Parameters {
 public:
  explicit Parameters(std::initializer_list<Value> values) {
    numbers_.reserve(values.size());
    for (const Value& value : values) {
      if (const auto* number = std::get_if<std::int64_t>(&value)) {
        add(numbers_.emplace_back(std::to_string(*number)), false);
      } else if (const auto* text = std::get_if<std::string_view>(&value)) {
        add(*text, true);
      } else {
        add(std::get<Blob>(value).bytes, true);
      }
    }
  }

  [[nodiscard]] int count() const { return static_cast<int>(values_.size()); }
  [[nodiscard]] const char* const* values() const { return values_.data(); }
  [[nodiscard]] const int* lengths() const { return lengths_.data(); }
  [[nodiscard]] const int* formats() const { return formats_.data(); }

 private:
  void add(std::string_view bytes, bool binary) {
    values_.push_back(bytes.data() != nullptr ? bytes.data() : "");
    lengths_.push_back(static_cast<int>(bytes.size()));
    formats_.push_back(binary ? 1 : 0);
  }

  std::vector<std::string> numbers_;
  std::vector<const char*> values_;
  std::vector<int> lengths_;
  std::vector<int> formats_;
};

// Takes the rows from the wire one by one, so that a million need no memory.
class PostgresRows final : public Rows {
 public:
  PostgresRows(PGconn* connection, const std::string& statement,
               std::initializer_list<Value> values, const std::string& name)
      : connection_(connection), name_(name) {
    const Parameters parameters(values);
    constexpr int kBinary = 1;
    const int sent =
        PQsendQueryParams(connection_, translated(statement).c_str(), parameters.count(), nullptr,
                          parameters.values(), parameters.lengths(), parameters.formats(), kBinary);
    if (sent != 1) rethrow(name_, connection_, nullptr);
    PQsetSingleRowMode(connection_);
  }
  PostgresRows(const PostgresRows&) = delete;
  PostgresRows& operator=(const PostgresRows&) = delete;
  ~PostgresRows() override {
    while (const Result rest{PQgetResult(connection_)}) {
    }
  }

  bool next() override {
    row_.reset(PQgetResult(connection_));
    if (!row_) return false;
    switch (PQresultStatus(row_.get())) {
      case PGRES_SINGLE_TUPLE:
        return true;
      case PGRES_TUPLES_OK:
      case PGRES_COMMAND_OK:
        return false;
      default:
        rethrow(name_, connection_, row_.get());
    }
  }
  [[nodiscard]] std::int64_t integer(int column) const override {
    const char* const at = PQgetvalue(row_.get(), 0, column);
    return PQgetlength(row_.get(), 0, column) == sizeof(std::int64_t)
               ? io::load_as<std::int64_t>(at, std::endian::big)
               : io::load_as<std::int32_t>(at, std::endian::big);
  }
  [[nodiscard]] std::string bytes(int column) const override {
    return {PQgetvalue(row_.get(), 0, column),
            static_cast<std::size_t>(PQgetlength(row_.get(), 0, column))};
  }

 private:
  PGconn* connection_;
  const std::string& name_;
  Result row_;
};

// Where a user's programs keep what can be made anew. Empty where there is no such place.
fs::path cache_folder() {
  for (const auto& [variable, below] :
       {std::pair{"XDG_CACHE_HOME", "morsel"}, std::pair{"HOME", ".cache/morsel"}}) {
    const char* const value = std::getenv(variable);
    if (value == nullptr || !fs::path(value).is_absolute()) continue;
    const fs::path folder = fs::path(value) / below;
    std::error_code error;
    fs::create_directories(folder, error);
    if (!error) return folder;
  }
  return {};
}

class Postgres final : public Connection {
 public:
  Postgres(std::string address, Access access)
      : Connection(without_password(address)), address_(std::move(address)), access_(access) {
    reconnect();
  }

  std::unique_ptr<Rows> query(const std::string& statement,
                              std::initializer_list<Value> parameters) override {
    return std::make_unique<PostgresRows>(link_.get(), statement, parameters, name());
  }
  void run_script(const std::string& statements) override {
    const Result result(PQexec(link_.get(), statements.c_str()));
    const ExecStatusType status = PQresultStatus(result.get());
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK) {
      rethrow(name(), link_.get(), result.get());
    }
  }

  // Writers take turns, so that the numbers of changes become visible in their order.
  void begin(Mode mode) override {
    try {
      run_script(mode == Mode::kRead ? "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY"
                                     : fmt::format("BEGIN ISOLATION LEVEL READ COMMITTED; SELECT "
                                                   "pg_advisory_xact_lock({})",
                                                   kApplicationId));
    } catch (...) {
      roll_back();
      throw;
    }
  }
  void commit() override { run_script("COMMIT"); }
  void roll_back() noexcept override { PQclear(PQexec(link_.get(), "ROLLBACK")); }

  void reconnect() override {
    // What the address says comes after the defaults and wins.
    constexpr std::array keywords{"fallback_application_name", "connect_timeout",
                                  "tcp_user_timeout",          "dbname",
                                  "client_encoding",           static_cast<const char*>(nullptr)};
    const std::array values{"morsel",         "10",   "30000",
                            address_.c_str(), "UTF8", static_cast<const char*>(nullptr)};
    link_.reset(PQconnectdbParams(keywords.data(), values.data(), 1));
    if (PQstatus(link_.get()) != CONNECTION_OK) {
      throw LostConnection(
          fmt::format("{}: cannot connect: {}", name(), one_line(PQerrorMessage(link_.get()))));
    }
    PQsetNoticeReceiver(
        link_.get(), [](void*, const PGresult*) {}, nullptr);
    run_script(
        fmt::format("SET search_path TO morsel; SET lock_timeout TO '60s';"
                    "SET default_transaction_read_only TO {}",
                    access_ == Access::kRead ? "on" : "off"));
  }

  [[nodiscard]] const Schema& schema() const override { return kPostgresSchema; }
  int version() override {
    if (integer("SELECT count(*) FROM pg_catalog.pg_namespace WHERE nspname = 'morsel'") == 0) {
      return 0;
    }
    if (integer("SELECT count(*) FROM pg_catalog.pg_tables WHERE schemaname = 'morsel' AND "
                "tablename = 'version'") == 0) {
      throw Error(ErrorCode::kInput,
                  name() + ": its schema morsel is not of morsel; name another database");
    }
    return static_cast<int>(integer("SELECT version FROM version").value_or(-1));
  }
  void set_version(int version) override {
    run("UPDATE version SET version = ?1", {static_cast<std::int64_t>(version)});
  }

  [[nodiscard]] fs::path block_prefix() const override {
    const fs::path folder = cache_folder();
    return folder.empty() ? folder : folder / Fingerprint().add(name()).hex_128();
  }
  // The server checks its pages where its administrator asked for it; rows have our checksums.
  std::vector<std::string> storage_findings(int /*most*/) override { return {}; }

 private:
  std::string address_;
  Access access_;
  Link link_;
};

}  // namespace

bool is_postgres(std::string_view place) {
  return place.starts_with("postgresql://") || place.starts_with("postgres://");
}

std::string without_password(std::string address) {
  const std::size_t user = address.find("://") + 3;
  const std::size_t end = std::min(address.find_first_of("/?", user), address.size());
  const std::size_t at = address.rfind('@', end);
  const std::size_t colon = address.find(':', user);
  if (at != std::string::npos && at >= user && colon < at) address.erase(colon, at - colon);
  for (const std::string_view option :
       {"?password=", "&password=", "?sslpassword=", "&sslpassword="}) {
    for (std::size_t begin = 0; (begin = address.find(option, begin)) != std::string::npos;) {
      begin += option.size();
      address.replace(begin, std::min(address.find('&', begin), address.size()) - begin, "***");
    }
  }
  return address;
}

std::unique_ptr<Connection> open_postgres(const std::string& address, Access access) {
  return std::make_unique<Postgres>(address, access);
}

}  // namespace morsel::store
