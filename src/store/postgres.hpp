// A database for many machines: the schema `morsel` in a database of a PostgreSQL server.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "store/connection.hpp"

namespace morsel::store {

/// Whether a place is the address of a server rather than a file.
[[nodiscard]] bool is_postgres(std::string_view place);

/// The address without a password, for messages.
[[nodiscard]] std::string without_password(std::string address);

/// Connects to the server. What the address leaves open comes from libpq's environment variables
/// and ~/.pgpass.
[[nodiscard]] std::unique_ptr<Connection> open_postgres(const std::string& address, Access access);

}  // namespace morsel::store
