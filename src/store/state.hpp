// What a Database holds; shared by the files that implement it.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/search.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "store/connection.hpp"

namespace morsel {

struct Database::State {
  std::filesystem::path file;
  SQLite::Database connection;
  std::mutex mutex = {};  // guards all below `file`: a connection is not for several threads
  std::shared_ptr<const SearchBlock> block = {};
  std::int64_t block_token = 0;  // of the state that `block` was made from
  std::shared_ptr<const std::vector<ShapeInfo>> shapes = {};
  std::int64_t shapes_token = 0;  // of the state that `shapes` was read from

  /// Calls work() alone and with SQLite's failures as morsel::Error.
  template <class Work>
  decltype(auto) exclusively(const Work& work) {
    const std::lock_guard lock(mutex);
    return store::guarded(file, work);
  }

  /// As exclusively(), in a transaction that is committed when work() returns.
  template <class Work>
  auto change(const Work& work) {
    return exclusively([&] {
      SQLite::Transaction transaction(connection, SQLite::TransactionBehavior::IMMEDIATE);
      auto result = work();
      transaction.commit();
      return result;
    });
  }

  /// As exclusively(), on one state of the database whatever others write meanwhile.
  template <class Work>
  auto look(const Work& work) {
    return exclusively([&] {
      const SQLite::Transaction transaction(connection);
      return work();
    });
  }

  // search.cpp
  /// The answer of a block, confirmed by the database; nothing when the two disagree.
  std::optional<std::vector<LookAlike>> search_block(const SearchBlock& from,
                                                     const Signature& query, std::size_t top,
                                                     const MatchOptions& options);
  void drop_block();
  /// What is wrong with the block of the current state. Within look().
  std::vector<std::string> check_block();
};

}  // namespace morsel
