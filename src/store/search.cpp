// Look-alikes through a block of all signatures beside the database, and all scores at once.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <morsel/search.hpp>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

#include "base/threads.hpp"
#include "io/source.hpp"
#include "store/rows.hpp"
#include "store/state.hpp"

namespace morsel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBlockExtension = ".block";

// Rows of shapes with their signatures, as `rest` chooses and orders them.
SQLite::Statement select_signatures(SQLite::Database& connection, const char* rest) {
  return {connection, fmt::format("SELECT {}, signatures.signature FROM shapes JOIN signatures ON "
                                  "signatures.id = shapes.signature {}",
                                  store::kShapeColumns, rest)};
}

// Of a row of select_signatures().
Signature signature_of(SQLite::Statement& row, const ShapeInfo& info, const fs::path& file) {
  return store::read_signature(row.getColumn(7), info.name, file);
}

// Calls visit(info, signature) for each shape by name.
template <class Visit>
void each_signature(SQLite::Database& connection, const fs::path& file, const Visit& visit) {
  SQLite::Statement statement = select_signatures(connection, "ORDER BY name");
  while (statement.executeStep()) {
    ShapeInfo info = store::read_shape(statement, file).info;
    Signature signature = signature_of(statement, info, file);
    visit(std::move(info), std::move(signature));
  }
}

struct NamedSignatures {
  std::vector<ShapeInfo> infos;  // by name
  std::vector<Signature> signatures;
};

NamedSignatures read_signatures(SQLite::Database& connection, const fs::path& file) {
  NamedSignatures all;
  each_signature(connection, file, [&](ShapeInfo info, Signature signature) {
    all.infos.push_back(std::move(info));
    all.signatures.push_back(std::move(signature));
  });
  return all;
}

// The token in its name says which state of the database a block was made from.
fs::path block_path(const fs::path& file, std::int64_t token) {
  fs::path path = file;
  path += fmt::format("-{:016x}{}", static_cast<std::uint64_t>(token), kBlockExtension);
  return path;
}

// Takes away the blocks of earlier states.
void remove_blocks(const fs::path& file, const fs::path& but) {
  const std::string prefix = file.filename().string() + "-";
  const std::size_t length = prefix.size() + 16 + std::string(kBlockExtension).size();
  std::error_code ignored;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::absolute(file).parent_path(), ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.size() == length && name.starts_with(prefix) && name.ends_with(kBlockExtension) &&
        name != but.filename().string()) {
      fs::remove(entry.path(), ignored);
    }
  }
}

std::shared_ptr<const SearchBlock> open_block(const fs::path& path, std::size_t count) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return nullptr;
  try {
    auto block = std::make_shared<const SearchBlock>(SearchBlock::open(path));
    return block->size() == count ? block : nullptr;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInput) throw;
    return nullptr;  // damaged: to be made anew
  }
}

// Nothing when it cannot be written: the folder may be read-only.
std::shared_ptr<const SearchBlock> make_block(SQLite::Database& connection, const fs::path& file,
                                              const fs::path& path) {
  try {
    SearchBlockWriter writer(path);
    each_signature(connection, file, [&](const ShapeInfo& info, const Signature& signature) {
      writer.add(info.name, signature);
    });
    writer.commit();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kOutput) throw;
    return nullptr;
  }
  remove_blocks(file, path);
  return std::make_shared<const SearchBlock>(SearchBlock::open(path));
}

std::vector<LookAlike> score_all(SQLite::Database& connection, const fs::path& file,
                                 const Signature& query, std::size_t top,
                                 const MatchOptions& options) {
  std::vector<LookAlike> best;  // a heap, the worst at the front
  const auto better = [](const LookAlike& a, const LookAlike& b) {
    return a.score != b.score ? a.score > b.score : a.info.name < b.info.name;
  };
  each_signature(connection, file, [&](ShapeInfo info, const Signature& signature) {
    best.push_back({std::move(info), match_score(query, signature, options)});
    std::push_heap(best.begin(), best.end(), better);
    if (best.size() <= top) return;
    std::pop_heap(best.begin(), best.end(), better);
    best.pop_back();
  });
  std::sort_heap(best.begin(), best.end(), better);
  return best;
}

// What the database itself says of one hit; nothing when it says anything else.
std::optional<LookAlike> confirmed(SQLite::Database& connection, const fs::path& file,
                                   const std::string& name, double score, const Signature& query,
                                   const MatchOptions& options) {
  SQLite::Statement statement = select_signatures(connection, "WHERE name = ?");
  statement.bind(1, name);
  if (!statement.executeStep()) return std::nullopt;
  LookAlike hit{store::read_shape(statement, file).info, 0.0};
  const Signature signature = signature_of(statement, hit.info, file);
  hit.score = match_score(query, signature, options);
  if (hit.score != score) return std::nullopt;
  return hit;
}

}  // namespace

std::vector<LookAlike> Database::search(const Signature& query, std::size_t top,
                                        const MatchOptions& options) const {
  options.check();
  // A block that does not agree with the database is made anew: once because it is damaged, more
  // often only while others write.
  constexpr int kMostAttempts = 5;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    std::optional<std::vector<LookAlike>> exhaustive;
    const std::shared_ptr<const SearchBlock> block = state_->look([&] {
      const std::int64_t token = store::state_token(state_->connection);
      if (state_->block && state_->block_token == token) return state_->block;
      const auto count = state_->connection.execAndGet("SELECT count(*) FROM shapes").getInt64();
      const fs::path path = block_path(state_->file, token);
      state_->block = open_block(path, static_cast<std::size_t>(count));
      state_->block_token = token;
      if (state_->block) return state_->block;
      state_->block = make_block(state_->connection, state_->file, path);
      if (!state_->block) {
        exhaustive = score_all(state_->connection, state_->file, query, top, options);
      }
      return state_->block;
    });
    if (exhaustive) return *std::move(exhaustive);
    if (auto found = state_->search_block(*block, query, top, options)) return *std::move(found);
    state_->drop_block();
  }
  throw Error(ErrorCode::kInput, state_->file.string() +
                                     ": the search block beside it does not agree with it; run "
                                     "check");
}

std::optional<std::vector<LookAlike>> Database::State::search_block(const SearchBlock& from,
                                                                    const Signature& query,
                                                                    std::size_t top,
                                                                    const MatchOptions& options) {
  std::vector<Hit> hits;
  try {
    hits = from.search(query, top, options);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInput) throw;
    return std::nullopt;
  }
  return look([&]() -> std::optional<std::vector<LookAlike>> {
    std::vector<LookAlike> found;
    for (const Hit& hit : hits) {
      const std::string name(from.name(hit.index));
      auto look_alike = confirmed(connection, file, name, hit.score, query, options);
      if (!look_alike) return std::nullopt;
      found.push_back(*std::move(look_alike));
    }
    return found;
  });
}

void Database::State::drop_block() {
  exclusively([&] {
    std::error_code ignored;
    fs::remove(block_path(file, block_token), ignored);
    block.reset();
  });
}

namespace {

SimilarityMatrix score_pairs(NamedSignatures all, const MatchOptions& options, int threads,
                             const Progress* progress) {
  const std::size_t count = all.infos.size();
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t i) {
      return std::tie(all.infos[i].class_name, all.infos[i].name);
    };
    return key(a) < key(b);
  });
  SimilarityMatrix matrix;
  for (const std::size_t i : order) matrix.shapes.push_back(std::move(all.infos[i]));
  matrix.scores.assign(count * count, 1.0);
  std::atomic<std::size_t> done{0};
  parallel_rows(count, threads, [&](std::size_t row) {
    for (std::size_t column = 0; column < row; ++column) {
      if (progress != nullptr) progress->check();
      const double score =
          match_score(all.signatures[order[row]], all.signatures[order[column]], options);
      matrix.scores[row * count + column] = score;
      matrix.scores[column * count + row] = score;
    }
    const std::size_t pairs = done += row;
    const double most = 0.5 * static_cast<double>(count) * static_cast<double>(count);
    if (progress != nullptr) progress->report("compare", static_cast<double>(pairs) / most);
  });
  return matrix;
}

}  // namespace

SimilarityMatrix Database::matrix(const MatchOptions& options, int threads,
                                  const Progress* progress) const {
  options.check();
  return score_pairs(
      state_->look([&] { return read_signatures(state_->connection, state_->file); }), options,
      threads, progress);
}

SimilarityMatrix Database::matrix_of(std::span<const std::string> names,
                                     const MatchOptions& options, int threads,
                                     const Progress* progress) const {
  options.check();
  NamedSignatures chosen = state_->look([&] {
    NamedSignatures found;
    SQLite::Statement statement = select_signatures(state_->connection, "WHERE name = ?");
    for (const std::string& name : names) {
      statement.reset();
      statement.bind(1, name);
      if (!statement.executeStep()) store::throw_missing(name, state_->file);
      ShapeInfo info = store::read_shape(statement, state_->file).info;
      found.signatures.push_back(signature_of(statement, info, state_->file));
      found.infos.push_back(std::move(info));
    }
    return found;
  });
  return score_pairs(std::move(chosen), options, threads, progress);
}

std::vector<std::string> Database::State::check_block() {
  const fs::path path = block_path(file, store::state_token(connection));
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return {};
  const auto finding = [&](const std::string& reason) {
    return std::vector<std::string>{path.string() + ": " + reason + "; delete it"};
  };
  try {
    const NamedSignatures all = read_signatures(connection, file);
    const SearchBlock found = SearchBlock::open(path);
    if (found.size() != all.infos.size()) return finding("holds another number of shapes");
    for (std::size_t i = 0; i < found.size(); ++i) {
      // Blocks may order the shapes as they like.
      const auto at = std::lower_bound(
          all.infos.begin(), all.infos.end(), found.name(i),
          [](const ShapeInfo& info, std::string_view name) { return info.name < name; });
      const auto index = static_cast<std::size_t>(at - all.infos.begin());
      if (at == all.infos.end() || at->name != found.name(i) ||
          found.signature(i) != all.signatures[index]) {
        return finding("differs from the database");
      }
    }
  } catch (const Error& error) {
    return {std::string(error.what()) + "; delete the block " + path.string()};
  }
  return {};
}

}  // namespace morsel
