// morsel-bench stability: how far a signature moves when the same shape is measured otherwise.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "collection.hpp"
#include "commands.hpp"
#include "isolated.hpp"
#include "pose.hpp"
#include "ranking.hpp"
#include "run_options.hpp"
#include "sampling.hpp"
#include "summary.hpp"

namespace morsel::bench {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct StabilityOptions : RunOptions {
  std::filesystem::path block;
  std::vector<std::size_t> densities{5000, 10000, 50000, 100000, 200000};
  std::size_t per_class = 1;
};

// How a shape is measured anew.
struct Variant {
  std::string name;
  CloudOptions cloud;
  bool posed_anew = true;
  bool reversed = false;
};

std::vector<Variant> variants_of(const StabilityOptions& options) {
  const CloudOptions same = options.cloud(0.0);
  CloudOptions other = same;
  ++other.seed;
  std::vector<Variant> all;
  all.push_back({"another order", same, false, true});
  all.push_back({"another pose", same});
  all.push_back({"another sampling", other});
  for (const std::size_t points : options.densities) {
    CloudOptions cloud = other;
    cloud.points = points;
    all.push_back({fmt::format("{} points", points), cloud});
  }
  for (const double level : options.noise) {
    CloudOptions cloud = other;
    cloud.noise = level;
    all.push_back({fmt::format("noise {:g}", level), cloud});
  }
  return all;
}

std::vector<Signature> read_stored(const std::filesystem::path& path,
                                   const std::vector<ClassedShape>& shapes) {
  const SearchBlock block = SearchBlock::open(path);
  std::vector<Signature> stored;
  for (std::size_t i = 0; i < block.size() && i < shapes.size(); ++i) {
    if (block.name(i) == shapes[i].name) stored.push_back(block.signature(i));
  }
  if (stored.size() != shapes.size() || block.size() != shapes.size()) {
    throw Error(ErrorCode::kUsage,
                fmt::format("{}: does not hold the {} shapes asked for; write it by "
                            "`morsel-bench retrieval DIR --block` with the same options",
                            path.string(), shapes.size()));
  }
  return stored;
}

// The first few of each class.
std::vector<std::size_t> queries_of(const std::vector<ClassedShape>& shapes,
                                    std::size_t per_class) {
  std::map<std::string, std::size_t> taken;
  std::vector<std::size_t> queries;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (taken[shapes[i].category]++ < per_class) queries.push_back(i);
  }
  return queries;
}

json measure(const ClassedShape& shape, int id, const StabilityOptions& options,
             const Variant& variant) {
  const Cloud cloud = sample_cloud(read_mesh(shape.path), id, variant.cloud);
  const std::uint64_t pose = options.seed + (variant.posed_anew ? 1 : 0);
  std::vector<Vec3> points = posed(cloud.points, seed_of_model(pose, id));
  if (variant.reversed) std::ranges::reverse(points);
  return to_json(make_signature(segment(points, options.segment()), 1));
}

Signature signature_of(const Outcome& outcome) {
  return outcome.error.empty() ? signature_from_json(outcome.value.get<std::string>())
                               : Signature{};
}

double changed_values(const Signature& a, const Signature& b) {
  if (a.tables.size() != b.tables.size()) return static_cast<double>(a.tables.size());
  double changed = 0.0;
  for (std::size_t i = 0; i < a.tables.size(); ++i) changed += a.tables[i] != b.tables[i] ? 1 : 0;
  return changed;
}

struct Moved {
  std::vector<double> distances;  // to the stored signature of the same shape
  std::vector<double> changed;    // values of its tables
  Retrieval ranked;
};

Moved compare(const std::vector<Signature>& measured, const std::vector<Signature>& stored,
              const std::vector<std::size_t>& queries, const std::vector<std::string>& categories) {
  Moved moved;
  std::vector<double> scores;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Signature& own = stored[queries[i]];
    moved.distances.push_back(std::log(1.0 / match_score(measured[i], own)));
    moved.changed.push_back(changed_values(own, measured[i]));
    for (const Signature& shape : stored) scores.push_back(match_score(measured[i], shape));
  }
  moved.ranked = rank(scores, categories, queries);
  return moved;
}

void print_and_add(const std::string& name, const Moved& moved, ordered_json& report) {
  std::vector<double> d = moved.distances;
  std::ranges::sort(d);
  const double high = d[(d.size() * 9 - 1) / 10];
  fmt::print("{:<18}{:8.3f}{:8.3f}{:8.3f}{:8.3f}{:8.0f}{:8.0f}  {:7.3f}{:7.3f}{:7.3f}{:7.3f}\n",
             name, median(d), high, d.back(), std::exp(-median(d)), median(moved.changed),
             std::ranges::max(moved.changed), moved.ranked.nearest, moved.ranked.first_tier,
             moved.ranked.second_tier, moved.ranked.gain);
  std::fflush(stdout);
  ordered_json run = {
      {"run", name}, {"distances", moved.distances}, {"changed_values", moved.changed}};
  add_measures(moved.ranked, run);
  report["runs"].push_back(std::move(run));
}

void run(const StabilityOptions& options) {
  const std::vector<ClassedShape> shapes =
      list_shapes(options.folder, IdFilter::parse(options.ids));
  const std::vector<Signature> stored = read_stored(options.block, shapes);
  const std::vector<std::size_t> queries = queries_of(shapes, options.per_class);
  const std::vector<Variant> variants = variants_of(options);
  const std::vector<std::string> categories = categories_of(shapes);

  ordered_json report = report_head("stability", options);
  for (const std::size_t query : queries) report["queries"].push_back(shapes[query].name);
  fmt::print("{} queries; D: distance to the same shape's stored signature\n", queries.size());
  fmt::print("{:<18}{:>8}{:>8}{:>8}{:>8}{:>16}  {:>7}{:>7}{:>7}{:>7}\n", "", "D", "90%", "most",
             "score", "values changed", "NN", "FT", "ST", "DCG");
  std::vector<Signature> same;
  for (const std::size_t query : queries) same.push_back(stored[query]);
  print_and_add("as stored", compare(same, stored, queries, categories), report);
  for (const Variant& variant : variants) {
    const auto outcomes = run_isolated(queries.size(), options.threads, [&](std::size_t job) {
      const std::size_t i = queries[job];
      return measure(shapes[i], static_cast<int>(i), options, variant);
    });
    std::vector<Signature> measured;
    for (const Outcome& outcome : outcomes) {
      measured.push_back(signature_of(outcome));
      if (!outcome.error.empty()) fmt::print("{}: {}\n", variant.name, outcome.error);
    }
    print_and_add(variant.name, compare(measured, stored, queries, categories), report);
  }
  if (!options.json.empty()) write_json(options.json, report);
}

}  // namespace

void add_stability(CLI::App& app) {
  auto options = std::make_shared<StabilityOptions>();
  options->noise = {0.001, 0.002, 0.003, 0.005, 0.01};
  CLI::App* command = app.add_subcommand(
      "stability", "Signatures of the same shapes in other poses, samplings, densities and noise");
  add_run_options(*command, *options);
  command
      ->add_option("--block", options->block,
                   "What the shapes are compared with: written by `morsel-bench retrieval`")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("--densities", options->densities, "Numbers of points to be tried")
      ->delimiter(',');
  command->add_option("--per-class", options->per_class, "Shapes of each class that are measured")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
