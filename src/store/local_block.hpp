// The copy of all signatures that searches read: a search block beside the file, or in the user's
// cache when the database is on a server.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <morsel/search.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "store/connection.hpp"

namespace morsel::store {

/// What a block says of a shape beside its signature.
struct BlockEntry {
  std::string_view name;
  std::int64_t id = 0;        ///< of its row
  std::int64_t checksum = 0;  ///< of its row
};

/// Throws Error(kInput) when the block is damaged there.
[[nodiscard]] BlockEntry block_entry(const SearchBlock& block, std::size_t index);

/// The block of the present state: the one that is there, else one made from that of an earlier
/// state and what changed since, else one made from everything. Nothing when it cannot be written.
/// Within one state of the database. Throws Error(kInput) when the database is damaged.
[[nodiscard]] std::shared_ptr<const SearchBlock> local_block(Connection& connection,
                                                             const StateMark& mark);

/// Deletes the block of that state, to be made anew.
void remove_block(const Connection& connection, const StateMark& mark);

/// What is wrong with the block of the present state, if there is one.
[[nodiscard]] std::vector<std::string> block_findings(Connection& connection);

}  // namespace morsel::store
