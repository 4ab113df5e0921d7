// morsel-bench articulated: do bent shapes find their like, and do their parts find each other?
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>

#include "bend.hpp"
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

// The classes whose members differ in posture.
constexpr std::array<std::string_view, 10> kBending{
    "Human", "Glasses", "Ant", "Octopus", "Teddy", "Hand", "Plier", "Bird", "Armadillo", "FourLeg"};

struct Mode {
  const char* name;
  MatchMode mode;
};
constexpr std::array<Mode, 2> kModes{
    {{"rigid", MatchMode::kRigid}, {"articulated", MatchMode::kArticulated}}};

// Points that the two segmentations of the same samples have in common, part by part.
using Common = std::vector<std::vector<std::size_t>>;

Common count_common(const Segmentation& a, const Segmentation& b) {
  Common common(a.parts.parts.size(), std::vector<std::size_t>(b.parts.parts.size(), 0));
  for (std::size_t i = 0; i < a.labels.size(); ++i) {
    if (a.labels[i] >= 0 && b.labels[i] >= 0) ++common[a.labels[i]][b.labels[i]];
  }
  return common;
}

// A shape in one posture, and a bent copy of it.
struct Postures {
  Signature straight;
  Signature bent;
  std::size_t limbs = 0;
  Common common;
};

json describe(const ClassedShape& shape, int id, const RunOptions& options) {
  const TriangleMesh mesh = read_mesh(shape.path);
  const std::uint64_t seed = seed_of_model(options.seed, id);
  const Bent bent = bend_limbs(mesh, seed);
  const Cloud cloud = sample_cloud(mesh, id, options.cloud(0.0));
  const std::vector<Vec3> carried = carried_over(cloud, mesh, bent.mesh);
  const Segmentation a = segment(posed(cloud.points, seed, false), options.segment());
  const Segmentation b = segment(posed(carried, seed + 1, false), options.segment());
  return {{"straight", to_json(make_signature(a, 1))},
          {"bent", to_json(make_signature(b, 1))},
          {"limbs", bent.limbs},
          {"common", count_common(a, b)}};
}

Postures postures_of(const Outcome& outcome) {
  if (!outcome.error.empty()) return {};
  return {signature_from_json(outcome.value.at("straight").get<std::string>()),
          signature_from_json(outcome.value.at("bent").get<std::string>()),
          outcome.value.at("limbs").get<std::size_t>(), outcome.value.at("common").get<Common>()};
}

std::size_t column_best(const Common& common, std::size_t column) {
  std::size_t best = 0;
  for (std::size_t row = 1; row < common.size(); ++row) {
    if (common[row][column] > common[best][column]) best = row;
  }
  return best;
}

// Share of the straight shape's volume whose part was given a counterpart that holds most of its
// points, or most of whose points it holds: a posture may cut a limb into more parts.
double share_well_matched(const Postures& postures, MatchMode mode) {
  const Match found = match(postures.straight, postures.bent, {.mode = mode});
  std::vector<char> good(postures.straight.parts.size(), 0);
  for (const MatchedPart& pair : found.matched) {
    const auto& row = postures.common[pair.target];
    const auto most = std::ranges::max_element(row) - row.begin();
    const std::size_t holder = column_best(postures.common, pair.source);
    if (most == pair.source || holder == static_cast<std::size_t>(pair.target)) {
      good[pair.target] = 1;
    }
  }
  double share = 0.0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    if (good[i] != 0) share += postures.straight.parts[i].weight;
  }
  return share;
}

struct Shapes {
  std::vector<ClassedShape> shapes;
  std::vector<std::string> categories;
  std::vector<std::size_t> bending;  // those of bending classes
};

Shapes list(const RunOptions& options) {
  Shapes all;
  all.shapes = list_shapes(options.folder, IdFilter::parse(options.ids));
  all.categories = categories_of(all.shapes);
  for (std::size_t i = 0; i < all.shapes.size(); ++i) {
    if (std::ranges::find(kBending, all.categories[i]) != kBending.end()) all.bending.push_back(i);
  }
  return all;
}

std::vector<double> scores(const std::vector<Signature>& queries,
                           const std::vector<Signature>& stored, MatchMode mode) {
  std::vector<double> all;
  for (const Signature& query : queries) {
    for (const Signature& shape : stored) {
      all.push_back(match_score(query, shape, {.mode = mode}));
    }
  }
  return all;
}

void print(const std::string& title, const Mode& mode, const Retrieval& r, ordered_json& report) {
  fmt::print("{:<36}{:<12}{:7.3f}{:7.3f}{:7.3f}{:7.3f}\n", title, mode.name, r.nearest,
             r.first_tier, r.second_tier, r.gain);
  ordered_json run = {{"run", title}, {"mode", mode.name}};
  add_measures(r, run);
  report["retrieval"].push_back(std::move(run));
}

// The models as they are, every one in the pose and at the noise of the run.
void measure_classes(const RunOptions& options, const Shapes& all, ordered_json& report) {
  const std::vector<double> levels = options.noise_levels();
  const std::size_t count = all.shapes.size();
  const auto outcomes = run_isolated(count * levels.size(), options.threads, [&](std::size_t job) {
    const int id = static_cast<int>(job % count);
    const Cloud cloud = sample_cloud(read_mesh(all.shapes[job % count].path), id,
                                     options.cloud(levels[job / count]));
    const auto points = posed(cloud.points, seed_of_model(options.seed, id));
    return json(to_json(make_signature(segment(points, options.segment()), 1)));
  });
  for (std::size_t level = 0; level < levels.size(); ++level) {
    std::vector<Signature> stored(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Outcome& outcome = outcomes[level * count + i];
      if (outcome.error.empty()) stored[i] = signature_from_json(outcome.value.get<std::string>());
    }
    std::vector<Signature> queries;
    for (const std::size_t i : all.bending) queries.push_back(stored[i]);
    for (const Mode& mode : kModes) {
      print(fmt::format("bending classes, noise {:g}", levels[level]), mode,
            rank(scores(queries, stored, mode.mode), all.categories, all.bending), report);
    }
  }
}

// Which shapes the bent copies of those in `bent` find, and whether their parts find each other.
void measure_bent(const std::string& title, const std::vector<std::size_t>& bent,
                  const std::vector<Postures>& postures, const Shapes& all, ordered_json& report) {
  std::vector<Signature> stored;
  for (const Postures& shape : postures) stored.push_back(shape.straight);
  std::vector<Signature> queries;
  for (const std::size_t i : bent) queries.push_back(postures[i].bent);
  for (const Mode& mode : kModes) {
    const std::vector<double> found = scores(queries, stored, mode.mode);
    print(fmt::format("{} {}", bent.size(), title), mode, rank(found, all.categories, bent),
          report);
    std::size_t first = 0;
    double well = 0.0;
    for (std::size_t q = 0; q < bent.size(); ++q) {
      const auto row = found.begin() + static_cast<std::ptrdiff_t>(q * stored.size());
      const auto best = std::max_element(row, row + static_cast<std::ptrdiff_t>(stored.size()));
      if (static_cast<std::size_t>(best - row) == bent[q]) ++first;
      well += share_well_matched(postures[bent[q]], mode.mode);
    }
    const auto count = static_cast<double>(std::max<std::size_t>(bent.size(), 1));
    fmt::print("  original first {:.3f}; {:.3f} of the volume in parts that correspond\n",
               static_cast<double>(first) / count, well / count);
    report["postures"].push_back({{"run", title},
                                  {"mode", mode.name},
                                  {"original_first", static_cast<double>(first) / count},
                                  {"corresponding", well / count}});
  }
}

void measure_postures(const RunOptions& options, const Shapes& all, ordered_json& report) {
  const auto outcomes = run_isolated(all.shapes.size(), options.threads, [&](std::size_t i) {
    return describe(all.shapes[i], static_cast<int>(i), options);
  });
  std::vector<Postures> postures;
  for (const Outcome& outcome : outcomes) postures.push_back(postures_of(outcome));
  const auto is_bent = [&](std::size_t i) { return postures[i].limbs > 0; };
  std::vector<std::size_t> every;
  for (std::size_t i = 0; i < postures.size(); ++i) {
    if (is_bent(i)) every.push_back(i);
  }
  std::vector<std::size_t> bending;
  std::ranges::copy_if(all.bending, std::back_inserter(bending), is_bent);
  measure_bent("bent copies of bending classes", bending, postures, all, report);
  measure_bent("bent copies of all classes", every, postures, all, report);
}

void run(const RunOptions& options) {
  const Shapes all = list(options);
  ordered_json report = report_head("articulated", options);
  fmt::print("{:<48}{:>7}{:>7}{:>7}{:>7}\n", "", "NN", "FT", "ST", "DCG");
  measure_classes(options, all, report);
  measure_postures(options, all, report);
  if (!options.json.empty()) write_json(options.json, report);
}

}  // namespace

void add_articulated(CLI::App& app) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      app.add_subcommand("articulated", "Ranks shapes that bend, and copies with bent limbs");
  add_run_options(*command, *options);
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
