// morsel-bench search: exact nearest signatures among very many.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <morsel/morsel.hpp>

#include "base/random.hpp"
#include "commands.hpp"
#include "flat_index.hpp"
#include "perturb.hpp"
#include "stopwatch.hpp"
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
  double noise = kPerturbation;
  std::uint64_t seed = 1;
  bool flat = false;
};

// Real signatures with a table for every one.
struct Real {
  std::vector<std::string> names;
  std::vector<Signature> signatures;
};

Real read_real(const std::filesystem::path& path) {
  const SearchBlock block = SearchBlock::open(path);
  Real real;
  for (std::size_t i = 0; i < block.size(); ++i) {
    Signature signature = block.signature(i);
    if (!(signature.size > 0.0)) continue;
    real.names.emplace_back(block.name(i));
    real.signatures.push_back(std::move(signature));
  }
  return real;
}

Signature one_like(const Real& real, std::size_t base, const SearchOptions& options,
                   Random& random) {
  return perturbed(real.signatures[base], real.signatures[random.below(real.names.size())],
                   options.noise, random);
}

void write_large(const SearchOptions& options, const Real& real) {
  Random random(options.seed);
  SearchBlockWriter writer(options.large);
  for (std::size_t i = 0; i < options.count; ++i) {
    const std::size_t base = i % real.names.size();
    writer.add(fmt::format("{}-{}", real.names[base], i), one_like(real, base, options, random));
  }
  writer.commit();
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

// Times of queries one after another: waited for, and spent on a core.
struct Times {
  std::vector<double> wall;
  std::vector<double> core;

  template <class Work>
  auto measure(const Work& work) {
    const Stopwatch watch;
    auto result = work();
    core.push_back(watch.core_seconds());
    wall.push_back(watch.seconds());
    return result;
  }
  void print(const std::string& what) const {
    fmt::print("{}: median {:.4f} s, worst {:.4f} s of {}; on the core {:.4f} s, {:.4f} s\n", what,
               median(wall), std::ranges::max(wall), wall.size(), median(core),
               std::ranges::max(core));
  }
};

void run_exact(const SearchOptions& options, const SearchBlock& block,
               const std::vector<Signature>& queries) {
  Times times;
  std::vector<double> shares;
  std::size_t equal = 0;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    std::size_t looked_at = 0;
    const auto hits =
        times.measure([&] { return block.search(queries[q], options.hits, {}, &looked_at); });
    shares.push_back(static_cast<double>(looked_at) / static_cast<double>(block.size()));
    if (q >= options.checked) continue;
    const std::vector<Hit> expected = exhaustive(block, queries[q], options.hits);
    const bool same = std::ranges::equal(hits, expected, [](const Hit& a, const Hit& b) {
      return a.index == b.index && a.score == b.score;
    });
    equal += same ? 1 : 0;
  }
  times.print(fmt::format("best {} of {}", options.hits, block.size()));
  fmt::print(
      "looked at whole: median {:.3f}%, most {:.3f}%; {} of {} checked equal the exhaustive "
      "answer\n",
      100.0 * median(shares), 100.0 * std::ranges::max(shares), equal,
      std::min(options.checked, queries.size()));
}

void run_flat(const SearchOptions& options, const SearchBlock& block,
              const std::vector<Signature>& queries) {
  FlatIndex index(block.size());
  for (std::size_t i = 0; i < block.size(); ++i) index.add(block.signature(i).tables);
  for (const bool squared : {true, false}) {
    Times times;
    for (std::size_t q = 0; q < std::min<std::size_t>(20, queries.size()); ++q) {
      times.measure([&] { return index.search(queries[q].tables, options.hits, squared); });
    }
    times.print(fmt::format("FAISS flat, {} floats a shape, {}", FlatIndex::kDimensions,
                            squared ? "L2" : "L1"));
  }
}

void run(const SearchOptions& options) {
  if (options.flat) FlatIndex(0);  // throws where there is none
  const Real real = read_real(options.block);
  const Stopwatch writing;
  write_large(options, real);
  const auto bytes = static_cast<double>(std::filesystem::file_size(options.large));
  fmt::print("writing {} signatures: {:.1f} s, {:.0f} bytes each\n", options.count,
             writing.seconds(), bytes / static_cast<double>(options.count));
  const Stopwatch opening;
  const SearchBlock block = SearchBlock::open(options.large);
  fmt::print("opening: {:.6f} s\n", opening.seconds());
  Random random(options.seed + 1);
  std::vector<Signature> queries;
  for (std::size_t q = 0; q < options.queries; ++q) {
    queries.push_back(one_like(real, random.below(real.names.size()), options, random));
  }
  // The file is in memory afterwards.
  (void)block.search(queries.front(), options.hits);
  for (std::size_t i = 0; i < block.size(); ++i) (void)block.name(i);
  run_exact(options, block, queries);
  if (options.flat) run_flat(options, block, queries);
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
  command
      ->add_option("--noise", options->noise,
                   "Change of each value as a share of it; another sampling changes some 0.02")
      ->capture_default_str();
  command->add_flag("--flat", options->flat, "Time FAISS's flat index of as many vectors, too");
  command->add_option("--seed", options->seed)->capture_default_str();
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
