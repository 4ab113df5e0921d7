// A database in one file: SQLite with a write-ahead log.
#pragma once

#include <filesystem>
#include <memory>

#include "store/connection.hpp"

namespace morsel::store {

/// Opens the file, or makes an empty one where `access` is kCreate.
[[nodiscard]] std::unique_ptr<Connection> open_sqlite(const std::filesystem::path& file,
                                                      Access access);

}  // namespace morsel::store
