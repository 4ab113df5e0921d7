// Single shapes in and out of a database.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <utility>

#include "io/source.hpp"
#include "store/connection.hpp"
#include "store/rows.hpp"
#include "store/state.hpp"

namespace morsel {
namespace {

using store::Connection;
using store::ShapeRow;

[[noreturn]] void fail(const Connection& connection, const std::string& name,
                       const std::string& reason) {
  throw Error(ErrorCode::kInput,
              fmt::format("{}: {} {}", connection.name(), io::in_quotes(name), reason));
}

bool passes(const ShapeInfo& info, const ShapeFilter& filter) {
  if (filter.class_name && info.class_name != *filter.class_name) return false;
  return !filter.tag ||
         std::find(info.tags.begin(), info.tags.end(), *filter.tag) != info.tags.end();
}

ShapeRow existing_shape(Connection& connection, const std::string& name) {
  std::optional<ShapeRow> row = store::find_shape(connection, name);
  if (!row) store::throw_missing(name, connection.name());
  return *std::move(row);
}

}  // namespace

Database::Database(std::unique_ptr<State> state) : state_(std::move(state)) {}
Database::Database(Database&&) noexcept = default;
Database& Database::operator=(Database&&) noexcept = default;
Database::~Database() = default;

Database Database::open(const std::filesystem::path& place, Access access) {
  return Database(std::unique_ptr<State>(new State{store::connect(place, access)}));
}

const std::filesystem::path& Database::file() const { return state_->file; }

std::size_t Database::size() const {
  return state_->exclusively([](Connection& connection) {
    return static_cast<std::size_t>(store::state_mark(connection).shapes);
  });
}

std::shared_ptr<const std::vector<ShapeInfo>> Database::shapes() const {
  return state_->look([&](Connection& connection) {
    const store::StateMark mark = store::state_mark(connection);
    if (state_->shapes && state_->shapes_mark == mark) return state_->shapes;
    auto infos = std::make_shared<std::vector<ShapeInfo>>();
    for (ShapeRow& row : store::all_shapes(connection)) infos->push_back(std::move(row.info));
    state_->shapes = std::move(infos);
    state_->shapes_mark = mark;
    return state_->shapes;
  });
}

std::vector<ShapeInfo> Database::list(const ShapeFilter& filter) const {
  const auto all = shapes();
  std::vector<ShapeInfo> infos;
  std::copy_if(all->begin(), all->end(), std::back_inserter(infos),
               [&](const ShapeInfo& info) { return passes(info, filter); });
  return infos;
}

std::optional<ShapeInfo> Database::find(const std::string& name) const {
  return state_->exclusively([&](Connection& connection) -> std::optional<ShapeInfo> {
    std::optional<ShapeRow> row = store::find_shape(connection, name);
    if (!row) return std::nullopt;
    return std::move(row->info);
  });
}

StoredShape Database::get(const std::string& name) const {
  return state_->look([&](Connection& connection) {
    ShapeRow row = existing_shape(connection, name);
    const auto rows = connection.query(
        fmt::format("SELECT {} FROM signatures WHERE id = ?1", store::kDataColumns),
        {row.signature});
    if (!rows->next()) fail(connection, name, "has no signature; run check");
    return StoredShape{std::move(row.info), store::read_data(*rows, connection.name())};
  });
}

Change Database::put(const ShapeInfo& info, const ShapeData& data) {
  const ShapeInfo proper = store::checked(info);
  return state_->change([&](Connection& connection) {
    return store::write_shape(connection, proper, store::insert_data(connection, data));
  });
}

std::optional<Change> Database::put_known(const ShapeInfo& info, const std::string& content) {
  const ShapeInfo proper = store::checked(info);
  const bool known = state_->exclusively(
      [&](Connection& connection) { return store::find_data(connection, content).has_value(); });
  if (!known) return std::nullopt;
  return state_->change([&](Connection& connection) -> std::optional<Change> {
    const auto signature = store::find_data(connection, content);
    if (!signature) return std::nullopt;  // removed meanwhile
    return store::write_shape(connection, proper, *signature);
  });
}

void Database::remove(std::span<const std::string> names) {
  state_->change([&](Connection& connection) {
    for (const std::string& name : names) {
      store::delete_shape(connection, existing_shape(connection, name));
    }
    return names.size();
  });
}

void Database::rename(const std::string& from, const std::string& to) {
  state_->change([&](Connection& connection) {
    const ShapeRow row = existing_shape(connection, from);
    ShapeInfo info = row.info;
    info.name = to;
    info = store::checked(info);
    if (store::find_shape(connection, to)) {
      fail(connection, to, "is another shape's name; remove that or choose another");
    }
    store::relabel_shape(connection, row, info);
    return true;
  });
}

void Database::put_failure(const std::string& name, const std::string& reason) {
  if (!store::can_be_name(name)) return;
  state_->change([&](Connection& connection) {
    connection.run(
        "INSERT INTO failures (name, reason) VALUES (?1, ?2) "
        "ON CONFLICT (name) DO UPDATE SET reason = excluded.reason",
        {name, reason});
    return true;
  });
}

std::map<std::string, std::string> Database::failures() const {
  return state_->exclusively([](Connection& connection) {
    std::map<std::string, std::string> failures;
    const auto rows = connection.query("SELECT name, reason FROM failures");
    while (rows->next()) failures.emplace(rows->bytes(0), rows->bytes(1));
    return failures;
  });
}

}  // namespace morsel
