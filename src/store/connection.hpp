// A connection to the SQLite file behind a database, and its failures as sentences.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <filesystem>
#include <morsel/database.hpp>
#include <string>
#include <utility>

namespace morsel::store {

/// The version of the tables that this program reads and writes; schema.cpp has its history.
inline constexpr int kSchemaVersion = 2;
/// The oldest one that it can bring up to date.
inline constexpr int kOldestVersion = 2;

/// Throws what SQLite said about `file` as morsel::Error.
[[noreturn]] void rethrow(const std::filesystem::path& file, const SQLite::Exception& error);

/// Calls work(); SQLite's exceptions come out as morsel::Error about `file`.
template <class Work>
decltype(auto) guarded(const std::filesystem::path& file, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const SQLite::Exception& error) {
    rethrow(file, error);
  }
}

/// Opens the file, checks that it is a database of morsel's and of a known version, creates or
/// migrates its tables as `access` allows.
[[nodiscard]] SQLite::Database connect(const std::filesystem::path& file, Access access);

/// Changes with every change of the shapes or signatures, never back to an earlier value.
[[nodiscard]] std::int64_t state_token(SQLite::Database& database);

}  // namespace morsel::store
