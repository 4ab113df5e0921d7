// Look-alikes through a local block of all signatures, and all scores at once.

#include <algorithm>
#include <atomic>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <morsel/partial.hpp>
#include <morsel/search.hpp>
#include <string>
#include <tuple>
#include <utility>

#include "base/threads.hpp"
#include "match/score.hpp"
#include "store/local_block.hpp"
#include "store/rows.hpp"
#include "store/state.hpp"

namespace morsel {
namespace {

using store::Connection;
using store::ShapeRow;

struct NamedSignatures {
  std::vector<ShapeInfo> infos;  // by name
  std::vector<Signature> signatures;

  void add(ShapeRow row, Signature signature) {
    infos.push_back(std::move(row.info));
    signatures.push_back(std::move(signature));
  }
};

std::vector<LookAlike> score_all(Connection& connection, const Signature& query, std::size_t top,
                                 const MatchOptions& options) {
  std::vector<LookAlike> best;  // a heap, the worst at the front
  const auto better = [](const LookAlike& a, const LookAlike& b) {
    return a.score != b.score ? a.score > b.score : a.info.name < b.info.name;
  };
  store::each_signature(
      connection, "ORDER BY name", {}, [&](ShapeRow row, const Signature& signature) {
        best.push_back({std::move(row.info), match_score(query, signature, options)});
        std::push_heap(best.begin(), best.end(), better);
        if (best.size() <= top) return;
        std::pop_heap(best.begin(), best.end(), better);
        best.pop_back();
      });
  std::sort_heap(best.begin(), best.end(), better);
  return best;
}

// What the database itself says of one hit; nothing when it says anything else.
std::optional<LookAlike> confirmed(Connection& connection, std::string_view name, double score,
                                   const Signature& query, const MatchOptions& options) {
  std::optional<LookAlike> hit;
  store::each_signature(connection, "WHERE name = ?1", {name},
                        [&](ShapeRow row, const Signature& signature) {
                          if (match_score(query, signature, options) != score) return;
                          hit = {std::move(row.info), score};
                        });
  return hit;
}

}  // namespace

std::vector<LookAlike> Database::search(const Signature& query, std::size_t top,
                                        const MatchOptions& options) const {
  check_for_signatures(options);
  // A block that does not agree with the database is made anew: once because it is damaged, more
  // often only while others write.
  constexpr int kMostAttempts = 5;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    std::optional<std::vector<LookAlike>> exhaustive;
    const std::shared_ptr<const SearchBlock> block = state_->look([&](Connection& connection) {
      const store::StateMark mark = store::state_mark(connection);
      if (state_->block && state_->block_mark == mark) return state_->block;
      state_->block = store::local_block(connection, mark);
      state_->block_mark = mark;
      if (!state_->block) exhaustive = score_all(connection, query, top, options);
      return state_->block;
    });
    if (exhaustive) return *std::move(exhaustive);
    if (auto found = state_->search_block(*block, query, top, options)) return *std::move(found);
    state_->drop_block();
  }
  throw Error(ErrorCode::kInput,
              state_->file.string() + ": its search block does not agree with it; run check");
}

std::vector<LookAlike> Database::search_partial(const Sketch& piece, std::size_t top,
                                                const MatchOptions& options, int threads,
                                                const Progress* progress) const {
  const auto stored =
      state_->look([&](Connection& connection) { return store::all_sketches(connection); });
  const auto surface_of = [](const Sketch& sketch) { return Surface(sketch.points, sketch.parts); };
  const std::vector<Hit> hits = morsel::search_partial(
      surface_of(piece), stored.size(),
      [&](std::size_t i) {
        const auto& [row, bytes] = stored[i];
        return surface_of(decode_sketch(bytes, state_->file.string() + ": " + row.info.name));
      },
      top, options, threads, progress);
  std::vector<LookAlike> found;
  for (const Hit& hit : hits) found.push_back({stored[hit.index].first.info, hit.score});
  return found;
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
  return look([&](Connection& of) -> std::optional<std::vector<LookAlike>> {
    std::vector<LookAlike> found;
    for (const Hit& hit : hits) {
      const store::BlockEntry entry = store::block_entry(from, hit.index);
      auto look_alike = confirmed(of, entry.name, hit.score, query, options);
      if (!look_alike) return std::nullopt;
      found.push_back(*std::move(look_alike));
    }
    return found;
  });
}

void Database::State::drop_block() {
  exclusively([&](Connection& of) {
    store::remove_block(of, block_mark);
    block.reset();
    return true;
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
  check_for_signatures(options);
  NamedSignatures all = state_->look([&](Connection& connection) {
    NamedSignatures found;
    store::each_signature(connection, "ORDER BY name", {}, [&](ShapeRow row, Signature signature) {
      found.add(std::move(row), std::move(signature));
    });
    return found;
  });
  return score_pairs(std::move(all), options, threads, progress);
}

SimilarityMatrix Database::matrix_of(std::span<const std::string> names,
                                     const MatchOptions& options, int threads,
                                     const Progress* progress) const {
  check_for_signatures(options);
  NamedSignatures chosen = state_->look([&](Connection& connection) {
    NamedSignatures found;
    for (const std::string& name : names) {
      const std::size_t before = found.infos.size();
      store::each_signature(connection, "WHERE name = ?1", {name},
                            [&](ShapeRow row, Signature signature) {
                              found.add(std::move(row), std::move(signature));
                            });
      if (found.infos.size() == before) store::throw_missing(name, connection.name());
    }
    return found;
  });
  return score_pairs(std::move(chosen), options, threads, progress);
}

}  // namespace morsel
