// What a Database holds; shared by the files that implement it.
#pragma once

#include <filesystem>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/search.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "store/connection.hpp"
#include "store/patience.hpp"

namespace morsel {

struct Database::State {
  using Mode = store::Connection::Mode;

  std::unique_ptr<store::Connection> connection;
  std::filesystem::path file = connection->name();
  std::mutex mutex = {};  // guards all: a connection is not for several threads
  std::shared_ptr<const SearchBlock> block = {};
  store::StateMark block_mark = {};  // of the state that `block` was made from
  std::shared_ptr<const std::vector<ShapeInfo>> shapes = {};
  store::StateMark shapes_mark = {};  // of the state that `shapes` was read from

  /// Calls work(connection) alone, again when the connection was lost meanwhile. What it had done
  /// may have been committed before: then it finds it done.
  template <class Work>
  auto exclusively(const Work& work) {
    const std::lock_guard lock(mutex);
    return store::patiently(*connection, [&] { return work(*connection); });
  }

  /// As exclusively(), in a transaction that is committed when work() returns.
  template <class Work>
  auto change(const Work& work) {
    return exclusively([&](auto& to) { return in_transaction(to, Mode::kWrite, work); });
  }

  /// As exclusively(), on one state of the database.
  template <class Work>
  auto look(const Work& work) {
    return exclusively([&](auto& from) { return in_transaction(from, Mode::kRead, work); });
  }

  /// As change() and look(), for work that cannot be done again: it reads or writes a stream.
  template <class Work>
  auto once(Mode mode, const Work& work) {
    const std::lock_guard lock(mutex);
    return in_transaction(*connection, mode, work);
  }

  // search.cpp
  /// The answer of a block, confirmed by the database; nothing when the two disagree.
  std::optional<std::vector<LookAlike>> search_block(const SearchBlock& from,
                                                     const Signature& query, std::size_t top,
                                                     const MatchOptions& options);
  void drop_block();

  template <class Work>
  static auto in_transaction(store::Connection& connection, Mode mode, const Work& work) {
    store::Transaction transaction(connection, mode);
    auto result = work(connection);
    transaction.commit();
    return result;
  }
};

}  // namespace morsel
