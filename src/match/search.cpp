// Exact search: the shapes are visited in order of lower bounds of their distances, until no other
// can be among the best.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <morsel/search.hpp>
#include <string_view>
#include <utility>

#include "match/block.hpp"
#include "match/score.hpp"

namespace morsel {
namespace {

using block::Group;
using block::Mapping;
using block::Row;

struct Ranked {
  double score = 0.0;
  std::string_view name;
  std::size_t index = 0;
};

bool better(const Ranked& a, const Ranked& b) {
  if (a.score != b.score) return a.score > b.score;
  return a.name != b.name ? a.name < b.name : a.index < b.index;
}

// The best shapes so far; the worst of them at the front.
class BestShapes {
 public:
  explicit BestShapes(std::size_t k) : k_(k) {}

  /// Whether one of that distance or more may still be among them.
  [[nodiscard]] bool may_take(double distance) const {
    return distance <= limit_ && score_of_distance(distance) >= threshold_;
  }
  void offer(const Ranked& shape) {
    if (shapes_.size() == k_ && !better(shape, shapes_.front())) return;
    shapes_.push_back(shape);
    std::ranges::push_heap(shapes_, better);
    if (shapes_.size() > k_) {
      std::ranges::pop_heap(shapes_, better);
      shapes_.pop_back();
    }
    if (shapes_.size() < k_) return;
    threshold_ = shapes_.front().score;
    // Somewhat beyond what the logarithm says: it only spares most the exponential.
    limit_ = (1.0 + 1e-9) * -std::log(threshold_) + 1e-9;
  }
  [[nodiscard]] std::vector<Hit> take() {
    std::ranges::sort(shapes_, better);
    std::vector<Hit> hits;
    for (const Ranked& shape : shapes_) hits.push_back({shape.index, shape.score});
    return hits;
  }

 private:
  std::size_t k_;
  std::vector<Ranked> shapes_;
  double threshold_ = -1.0;
  double limit_ = std::numeric_limits<double>::infinity();
};

// What is compared with every shape.
struct Query {
  Query(const Signature& of, const MatchOptions& with)
      : signature(of),
        options(with),
        tables(tables_of(of)),
        sums(block::run_sums(tables.data())),
        empty(!(of.size > 0.0)) {}
  const Signature& signature;
  const MatchOptions& options;
  std::array<std::uint8_t, kTableSize> tables;
  block::RunSums sums;
  bool empty;
};

// Looks at one shape whole.
void look_at(const Mapping& file, std::size_t index, const Query& query, BestShapes& best) {
  const Row row = file.row(index);
  const double distance = table_distance(block_sums(query.tables.data(), row.tables()),
                                         query.tables[0], row.tables()[0], query.options.mode);
  if (!best.may_take(distance)) return;
  double score = score_of_distance(distance);
  if (query.empty != row.is_empty()) {
    score = 0.0;
  } else if (!query.options.mirror) {
    score *= same_handedness(query.signature, file.signature(row));
  }
  best.offer({score, row.name, index});
}

using Bounds = std::array<double, block::kGroupRows>;

// Never above the distances of the shapes of a group. Whole columns at a time, which compilers turn
// into vector instructions.
void find_bounds(const char* columns, std::size_t rows, const Query& query, Bounds& bounds) {
  constexpr std::size_t kStripe = 256;  // rows whose sums stay in the nearest cache
  const block::Layout layout(rows);
  const auto* const solidity = reinterpret_cast<const std::uint8_t*>(columns + layout.solidity);
  for (std::size_t begin = 0; begin < rows; begin += kStripe) {
    const std::size_t count = std::min(kStripe, rows - begin);
    std::array<std::array<std::uint16_t, kStripe>, kTableBlocks.size()> apart{};
    std::size_t run = 0;
    for (std::size_t k = 0; k < apart.size(); ++k) {
      for (std::size_t r = 0; r < block::kRunsOfBlock[k]; ++r, ++run) {
        const auto* const sums =
            reinterpret_cast<const std::uint16_t*>(columns + layout.sums) + rows * run + begin;
        const std::uint16_t own = query.sums[run];
        for (std::size_t i = 0; i < count; ++i) {
          apart[k][i] = static_cast<std::uint16_t>(apart[k][i] + std::max(sums[i], own) -
                                                   std::min(sums[i], own));
        }
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      BlockSums sums{};
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] = apart[k][i];
      bounds[begin + i] =
          table_distance(sums, query.tables[0], solidity[begin + i], query.options.mode);
    }
  }
}

struct Candidate {
  double bound = 0.0;  // the distance is at least this
  std::size_t index = 0;
};

// The shapes that may be among the best. The likeliest of each group is looked at as the groups are
// passed, so that soon few are left.
std::vector<Candidate> find_candidates(const Mapping& file, const Query& query, BestShapes& best,
                                       std::size_t& looked_at) {
  std::vector<Candidate> candidates;
  Bounds bounds;
  std::size_t first = 0;
  for (const Group& group : file.groups()) {
    find_bounds(file.columns(group), group.rows, query, bounds);
    const auto end = bounds.begin() + static_cast<std::ptrdiff_t>(group.rows);
    const auto likeliest =
        static_cast<std::size_t>(std::min_element(bounds.begin(), end) - bounds.begin());
    if (best.may_take(bounds[likeliest])) {
      look_at(file, first + likeliest, query, best);
      ++looked_at;
      for (std::size_t i = 0; i < group.rows; ++i) {
        if (i != likeliest && best.may_take(bounds[i]))
          candidates.push_back({bounds[i], first + i});
      }
    }
    first += group.rows;
  }
  return candidates;
}

// Looks at candidates in ascending order of their bounds. The order is made in steps, so that the
// many that are never reached are not sorted.
void look_ascending(const Mapping& file, std::vector<Candidate>& candidates, const Query& query,
                    BestShapes& best, std::size_t& looked_at) {
  const auto before = [](const Candidate& a, const Candidate& b) {
    return a.bound != b.bound ? a.bound < b.bound : a.index < b.index;
  };
  for (std::size_t step = 256; !candidates.empty(); step *= 4) {
    std::erase_if(candidates, [&](const Candidate& c) { return !best.may_take(c.bound); });
    // The next ones go to the end, whence they are taken.
    const std::size_t rest = candidates.size() - std::min(step, candidates.size());
    const auto next = candidates.begin() + static_cast<std::ptrdiff_t>(rest);
    if (rest > 0) {
      std::nth_element(candidates.begin(), next, candidates.end(),
                       [&](const Candidate& a, const Candidate& b) { return before(b, a); });
    }
    std::sort(next, candidates.end(), before);
    for (auto candidate = next; candidate != candidates.end(); ++candidate) {
      if (!best.may_take(candidate->bound)) return;
      look_at(file, candidate->index, query, best);
      ++looked_at;
    }
    candidates.resize(rest);
  }
}

}  // namespace

SearchBlock::SearchBlock(std::unique_ptr<const Mapping> mapping) : mapping_(std::move(mapping)) {}
SearchBlock::SearchBlock(SearchBlock&&) noexcept = default;
SearchBlock& SearchBlock::operator=(SearchBlock&&) noexcept = default;
SearchBlock::~SearchBlock() = default;

SearchBlock SearchBlock::open(const std::filesystem::path& path) {
  return SearchBlock(std::make_unique<const Mapping>(path));
}

std::size_t SearchBlock::size() const { return mapping_->count(); }
std::string_view SearchBlock::name(std::size_t index) const { return mapping_->row(index).name; }
Signature SearchBlock::signature(std::size_t index) const {
  return mapping_->signature(mapping_->row(index));
}

std::vector<Hit> SearchBlock::search(const Signature& query, std::size_t k,
                                     const MatchOptions& options, std::size_t* looked_at) const {
  check_for_signatures(options);
  if (k == 0) return {};
  BestShapes best(k);
  std::size_t count = 0;
  if (options.method == Method::kPaper) {
    for (; count < size(); ++count) {
      const Row row = mapping_->row(count);
      best.offer({match_score(query, mapping_->signature(row), options), row.name, count});
    }
  } else {
    const Query compared(query, options);
    std::vector<Candidate> candidates = find_candidates(*mapping_, compared, best, count);
    look_ascending(*mapping_, candidates, compared, best, count);
  }
  if (looked_at != nullptr) *looked_at = count;
  return best.take();
}

}  // namespace morsel
