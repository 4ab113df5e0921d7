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

using store::ShapeRow;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& name,
                       const std::string& reason) {
  throw Error(ErrorCode::kInput,
              fmt::format("{}: {} {}", file.string(), io::in_quotes(name), reason));
}

bool passes(const ShapeInfo& info, const ShapeFilter& filter) {
  if (filter.class_name && info.class_name != *filter.class_name) return false;
  return !filter.tag ||
         std::find(info.tags.begin(), info.tags.end(), *filter.tag) != info.tags.end();
}

ShapeRow existing_shape(SQLite::Database& connection, const std::string& name,
                        const std::filesystem::path& file) {
  std::optional<ShapeRow> row = store::find_shape(connection, name, file);
  if (!row) store::throw_missing(name, file);
  return *std::move(row);
}

}  // namespace

Database::Database(std::unique_ptr<State> state) : state_(std::move(state)) {}
Database::Database(Database&&) noexcept = default;
Database& Database::operator=(Database&&) noexcept = default;
Database::~Database() = default;

Database Database::open(const std::filesystem::path& file, Access access) {
  return Database(std::unique_ptr<State>(new State{file, store::connect(file, access)}));
}

const std::filesystem::path& Database::file() const { return state_->file; }

std::size_t Database::size() const {
  return state_->exclusively([&] {
    const auto count = state_->connection.execAndGet("SELECT count(*) FROM shapes").getInt64();
    return static_cast<std::size_t>(count);
  });
}

std::shared_ptr<const std::vector<ShapeInfo>> Database::shapes() const {
  return state_->look([&] {
    const std::int64_t token = store::state_token(state_->connection);
    if (state_->shapes && state_->shapes_token == token) return state_->shapes;
    auto infos = std::make_shared<std::vector<ShapeInfo>>();
    for (ShapeRow& row : store::all_shapes(state_->connection, state_->file)) {
      infos->push_back(std::move(row.info));
    }
    state_->shapes = std::move(infos);
    state_->shapes_token = token;
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
  return state_->exclusively([&]() -> std::optional<ShapeInfo> {
    std::optional<ShapeRow> row = store::find_shape(state_->connection, name, state_->file);
    if (!row) return std::nullopt;
    return std::move(row->info);
  });
}

StoredShape Database::get(const std::string& name) const {
  return state_->look([&] {
    ShapeRow row = existing_shape(state_->connection, name, state_->file);
    SQLite::Statement statement(
        state_->connection,
        fmt::format("SELECT {} FROM signatures WHERE id = ?", store::kDataColumns));
    statement.bind(1, row.signature);
    if (!statement.executeStep()) fail(state_->file, name, "has no signature; run check");
    return StoredShape{std::move(row.info), store::read_data(statement, state_->file)};
  });
}

Change Database::put(const ShapeInfo& info, const ShapeData& data) {
  const ShapeInfo proper = store::checked(info);
  return state_->change([&] {
    const std::int64_t signature = store::insert_data(state_->connection, data);
    return store::write_shape(state_->connection, proper, signature, state_->file);
  });
}

std::optional<Change> Database::put_known(const ShapeInfo& info, const std::string& content) {
  const ShapeInfo proper = store::checked(info);
  const bool known = state_->exclusively(
      [&] { return store::find_data(state_->connection, content).has_value(); });
  if (!known) return std::nullopt;
  return state_->change([&]() -> std::optional<Change> {
    const auto signature = store::find_data(state_->connection, content);
    if (!signature) return std::nullopt;  // removed meanwhile
    return store::write_shape(state_->connection, proper, *signature, state_->file);
  });
}

void Database::remove(std::span<const std::string> names) {
  state_->change([&] {
    for (const std::string& name : names) {
      store::delete_shape(state_->connection,
                          existing_shape(state_->connection, name, state_->file));
    }
    return names.size();
  });
}

void Database::rename(const std::string& from, const std::string& to) {
  state_->change([&] {
    const ShapeRow row = existing_shape(state_->connection, from, state_->file);
    ShapeInfo info = row.info;
    info.name = to;
    info = store::checked(info);
    if (store::find_shape(state_->connection, to, state_->file)) {
      fail(state_->file, to, "is another shape's name; remove that or choose another");
    }
    store::relabel_shape(state_->connection, row, info);
    return true;
  });
}

}  // namespace morsel
