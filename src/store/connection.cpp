#include "store/connection.hpp"

#include <fmt/format.h>

#include "store/postgres.hpp"
#include "store/schema.hpp"
#include "store/sqlite.hpp"

namespace morsel::store {

std::optional<std::int64_t> Connection::integer(const std::string& statement,
                                                std::initializer_list<Value> parameters) {
  const std::unique_ptr<Rows> rows = query(statement, parameters);
  if (!rows->next()) return std::nullopt;
  const std::int64_t value = rows->integer(0);
  while (rows->next()) {
  }
  return value;
}

void Connection::run(const std::string& statement, std::initializer_list<Value> parameters) {
  const std::unique_ptr<Rows> rows = query(statement, parameters);
  while (rows->next()) {
  }
}

std::unique_ptr<Connection> connect(const std::filesystem::path& place, Access access) {
  std::unique_ptr<Connection> connection = is_postgres(place.string())
                                               ? open_postgres(place.string(), access)
                                               : open_sqlite(place, access);
  const int version = check_version(*connection);
  if (version == 0 && access != Access::kCreate) {
    throw Error(ErrorCode::kInput, connection->name() +
                                       ": the database is empty; index shapes into it to make one "
                                       "of morsel's");
  }
  if (version == kSchemaVersion) return connection;
  if (access == Access::kRead) {
    throw Error(ErrorCode::kInput, connection->name() +
                                       ": was written by an older morsel; change anything in it "
                                       "with this program to bring it up to date");
  }
  migrate(*connection);
  return connection;
}

StateMark state_mark(Connection& connection) {
  const auto rows = connection.query("SELECT sequence, digest, shapes FROM state WHERE id = 1");
  if (!rows->next()) {
    throw Error(ErrorCode::kInput, connection.name() +
                                       ": the database is damaged: it does not say its state; "
                                       "restore it from an export or a copy");
  }
  return {rows->integer(0), rows->integer(1), rows->integer(2)};
}

}  // namespace morsel::store
