// morsel-bench search: exact nearest signatures among very many.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <morsel/morsel.hpp>

#include "base/random.hpp"
#include "commands.hpp"
#include "summary.hpp"

namespace morsel::bench {
namespace {

struct SearchOptions {
  std::filesystem::path block;
  std::filesystem::path large = "morsel-bench-search.block";
  std::size_t count = 1000000;
  std::size_t queries = 200;
  std::size_t hits = 10;
  std::size_t checked = 3;
  std::uint64_t seed = 1;
};

double seconds_since(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

// A real signature, each table value changed by up to some tenths of itself, as another sampling,
// noise or another model of the kind would change it.
Signature perturbed(const Signature& base, Random& random) {
  Signature signature = base;
  const double amount = 0.3 * random.uniform();
  for (std::uint8_t& value : signature.tables) {
    const double changed = value + random.normal() * (amount * value + 1.0);
    value = static_cast<std::uint8_t>(std::lround(std::clamp(changed, 0.0, 255.0)));
  }
  return signature;
}

void write_large(const SearchOptions& options, const SearchBlock& real) {
  Random random(options.seed);
  std::vector<std::string> names;
  std::vector<Signature> signatures;
  for (std::size_t i = 0; i < options.count; ++i) {
    names.push_back(fmt::format("{}-{}", real.name(i % real.size()), i));
    signatures.push_back(perturbed(real.signature(i % real.size()), random));
  }
  write_search_block(options.large, names, signatures);
}

// What search() must equal.
std::vector<Hit> exhaustive(const SearchBlock& block, const Signature& query, std::size_t k) {
  std::vector<Hit> hits;
  for (std::size_t i = 0; i < block.size(); ++i) {
    hits.push_back({i, match_score(query, block.signature(i))});
  }
  std::ranges::sort(hits, [&](const Hit& a, const Hit& b) {
    return a.score != b.score ? a.score > b.score : block.name(a.index) < block.name(b.index);
  });
  hits.resize(std::min(k, hits.size()));
  return hits;
}

void run(const SearchOptions& options) {
  const SearchBlock real = SearchBlock::open(options.block);
  write_large(options, real);
  auto began = std::chrono::steady_clock::now();
  const SearchBlock block = SearchBlock::open(options.large);
  fmt::print("opening {} signatures: {:.6f} s\n", block.size(), seconds_since(began));
  Random random(options.seed + 1);
  std::vector<double> seconds;
  std::size_t equal = 0;
  for (std::size_t q = 0; q < options.queries; ++q) {
    const Signature query = perturbed(real.signature(random.below(real.size())), random);
    began = std::chrono::steady_clock::now();
    const std::vector<Hit> hits = block.search(query, options.hits);
    seconds.push_back(seconds_since(began));
    if (q >= options.checked) continue;
    const std::vector<Hit> expected = exhaustive(block, query, options.hits);
    const bool same = std::ranges::equal(hits, expected, [](const Hit& a, const Hit& b) {
      return a.index == b.index && a.score == b.score;
    });
    equal += same ? 1 : 0;
  }
  fmt::print(
      "best {} of {}: median {:.3f} s, worst {:.3f} s of {} queries; {} of {} checked equal "
      "the exhaustive answer\n",
      options.hits, block.size(), median(seconds), std::ranges::max(seconds), options.queries,
      equal, std::min(options.checked, options.queries));
  std::filesystem::remove(options.large);
}

}  // namespace

void add_search(CLI::App& app) {
  auto options = std::make_shared<SearchOptions>();
  CLI::App* command =
      app.add_subcommand("search", "Times exact searches among many perturbed signatures");
  command->add_option("BLOCK", options->block, "Signatures of `morsel-bench retrieval --block`")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("--count", options->count, "Signatures to search")->capture_default_str();
  command->add_option("--queries", options->queries)->capture_default_str();
  command->add_option("--top", options->hits, "Hits asked for")->capture_default_str();
  command->add_option("--check", options->checked, "Queries compared with the exhaustive answer")
      ->capture_default_str();
  command->add_option("--large", options->large, "Where the large block is written for a while")
      ->capture_default_str();
  command->add_option("--seed", options->seed)->capture_default_str();
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
