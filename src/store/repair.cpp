// Drops what is damaged, so that the rest can be used.

#include <fmt/format.h>

#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <string>
#include <vector>

#include "store/rows.hpp"
#include "store/state.hpp"

namespace morsel {
namespace {

using store::Connection;
using store::Rows;

struct Damage {
  std::int64_t row = 0;
  std::string reason;
};

// The rows of a query that read(row) throws at; their ids are in the first column.
template <class Read>
std::vector<Damage> damaged(Connection& connection, const std::string& query, const Read& read) {
  std::vector<Damage> damage;
  const auto rows = connection.query(query);
  while (rows->next()) {
    try {
      read(*rows);
    } catch (const Error& error) {
      damage.push_back({rows->integer(0), error.what()});
    }
  }
  return damage;
}

std::vector<Damage> damaged_signatures(Connection& connection) {
  return damaged(connection, fmt::format("SELECT {} FROM signatures", store::kDataColumns),
                 [&](const Rows& row) { (void)store::read_data(row, connection.name()); });
}

std::vector<Damage> damaged_shapes(Connection& connection) {
  return damaged(connection, fmt::format("SELECT {} FROM shapes", store::kShapeColumns),
                 [&](const Rows& row) { (void)store::read_shape(row, connection.name()); });
}

std::vector<Damage> shapes_without_signature(Connection& connection) {
  return damaged(connection, fmt::format("SELECT id, name {}", store::kShapesWithoutSignature),
                 [&](const Rows& row) {
                   throw Error(ErrorCode::kInput,
                               fmt::format("{}: shape '{}': its signature is missing",
                                           connection.name(), row.bytes(1)));
                 });
}

void recount(Connection& connection) {
  store::StateMark mark;
  {
    const auto rows = connection.query("SELECT checksum FROM shapes", {});
    for (; rows->next(); ++mark.shapes) mark.digest ^= rows->integer(0);
  }
  connection.run("UPDATE state SET sequence = sequence + 1, digest = ?1, shapes = ?2",
                 {mark.digest, mark.shapes});
}

}  // namespace

std::vector<std::string> Database::repair() {
  return state_->once(State::Mode::kWrite, [&](Connection& connection) {
    connection.rebuild_indices();
    std::vector<std::string> reasons;
    const auto drop = [&](const std::vector<Damage>& damage, const char* statement) {
      for (const auto& [row, reason] : damage) {
        connection.run(statement, {row});
        reasons.push_back(reason);
      }
    };
    drop(damaged_shapes(connection), "DELETE FROM shapes WHERE id = ?1");
    const std::vector<Damage> signatures = damaged_signatures(connection);
    for (const Damage& damage : signatures) {
      const auto rows =
          connection.query("SELECT name FROM shapes WHERE signature = ?1", {damage.row});
      while (rows->next()) {
        reasons.push_back(fmt::format("{}: shape '{}': its signature is damaged", connection.name(),
                                      rows->bytes(0)));
      }
    }
    for (const Damage& damage : signatures) {
      connection.run("DELETE FROM shapes WHERE signature = ?1", {damage.row});
    }
    drop(signatures, "DELETE FROM signatures WHERE id = ?1");
    drop(shapes_without_signature(connection), "DELETE FROM shapes WHERE id = ?1");
    connection.run(fmt::format("DELETE {}", store::kSignaturesWithoutShape));
    recount(connection);
    return reasons;
  });
}

}  // namespace morsel
