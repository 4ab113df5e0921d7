// morsel-bench peers: the parts that others find, against people's, beside ours.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "commands.hpp"
#include "isolated.hpp"
#include "measures.hpp"
#include "run_options.hpp"
#include "sampling.hpp"
#include "sdf.hpp"
#include "stopwatch.hpp"
#include "summary.hpp"
#include "supervoxels.hpp"
#include "tomato.hpp"

namespace morsel::bench {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct Options {
  RunOptions run;
  std::vector<std::string> only;
  // The best of a few that were tried on some of the models with ids 1 modulo 20.
  SdfOptions sdf{.clusters = 4};
  SupervoxelOptions supervoxels{
      .voxel = 0.012, .supervoxel = 0.04, .common_convex = 1, .smallest = 3};
  TomatoOptions tomato{.neighbors = 20, .density_neighbors = 500, .prominence = 0.2};
};

/// A label a face, and what they took.
struct Labeling {
  std::vector<int> faces;
  double core_seconds = 0.0;
};

struct Contender {
  std::string name;
  std::function<Labeling(const TriangleMesh& mesh, const Cloud& cloud)> run;
};

struct Result {
  double rand = 1.0;
  double parts = 0.0;
  double core_seconds = 0.0;
  std::string error;  ///< why there is no result
};

template <typename Label>
Labeling timed(const Label& label) {
  const Stopwatch watch;
  Labeling labeling{.faces = label()};
  labeling.core_seconds = watch.core_seconds();
  return labeling;
}

// `label` gives a label to each point.
template <typename Label>
auto on_points(const Label& label) {
  return [label](const TriangleMesh& mesh, const Cloud& cloud) {
    Labeling labeling = timed([&] { return label(cloud.points); });
    labeling.faces = face_labels(mesh, cloud, labeling.faces);
    return labeling;
  };
}

Contender ours(const std::string& name, RunOptions run) {
  run.method = name;
  return {.name = name == "default" ? "morsel" : name,
          .run = on_points([options = run.segment()](const std::vector<Vec3>& points) {
            return segment(points, options).labels;
          })};
}

Contender sdf(const SdfOptions& options) {
  return {.name = "SDF", .run = [options](const TriangleMesh& mesh, const Cloud& /*cloud*/) {
            return timed([&] { return sdf_labels(mesh, options); });
          }};
}

Contender tomato(const TomatoOptions& options) {
  return {.name = "ToMATo", .run = [options](const TriangleMesh& mesh, const Cloud& cloud) {
            const TomatoResult result = tomato(cloud.points, options);
            return Labeling{.faces = face_labels(mesh, cloud, result.labels),
                            .core_seconds = result.core_seconds};
          }};
}

std::vector<Contender> find_contenders(const Options& options) {
  std::vector<Contender> all = {ours("default", options.run), ours("paper", options.run),
                                sdf(options.sdf)};
  if (has_supervoxels()) {
    const SupervoxelOptions own = options.supervoxels;
    all.push_back(
        {"LCCP", on_points([own](const auto& points) { return lccp_labels(points, own); })});
    all.push_back(
        {"CPC", on_points([own](const auto& points) { return cpc_labels(points, own); })});
  }
  if (has_tomato()) all.push_back(tomato(options.tomato));
  if (options.only.empty()) return all;
  std::erase_if(all, [&](const Contender& contender) {
    return std::ranges::find(options.only, contender.name) == options.only.end();
  });
  if (all.empty()) throw Error(ErrorCode::kUsage, "--only names none that is there");
  return all;
}

// In a child process.
json evaluate(const Model& model, const Contender& contender, const CloudOptions& cloud) {
  const TriangleMesh mesh = read_mesh(model.mesh);
  const auto people = read_people(model, mesh.triangles.size());
  const Labeling labeling = contender.run(mesh, sample_cloud(mesh, model.id, cloud));
  std::vector<double> errors;
  for (const auto& person : people)
    errors.push_back(rand_error(count_pairs(person, labeling.faces)));
  return {{"rand", mean(errors)},
          {"parts", count_labels(labeling.faces)},
          {"core_seconds", labeling.core_seconds}};
}

Result result_of(const Outcome& outcome) {
  if (!outcome.error.empty()) return {.error = outcome.error};
  return {.rand = outcome.value.at("rand"),
          .parts = outcome.value.at("parts"),
          .core_seconds = outcome.value.at("core_seconds"),
          .error = {}};
}

// ---- tables ----

/// All models of one contender at one noise level.
struct Column {
  std::string name;
  std::vector<Result> results;
  std::vector<double> categories;  ///< mean Rand error of each
  double rand = 0.0;               ///< their mean
  double parts = 0.0;
  double median_seconds = 0.0;
  std::size_t failed = 0;
};

Column column_of(const std::string& name, std::vector<Result> results,
                 const std::vector<int>& ids) {
  Column column{.name = name, .results = std::move(results), .categories = {}};
  for (const auto& [category, members] : group_by_category(ids)) {
    std::vector<double> errors;
    for (const std::size_t i : members) errors.push_back(column.results[i].rand);
    column.categories.push_back(mean(errors));
  }
  column.rand = mean(column.categories);
  std::vector<double> parts;
  std::vector<double> seconds;
  for (const Result& result : column.results) {
    if (!result.error.empty()) {
      ++column.failed;
      continue;
    }
    parts.push_back(result.parts);
    seconds.push_back(result.core_seconds);
  }
  column.parts = mean(parts);
  column.median_seconds = median(std::move(seconds));
  return column;
}

template <typename Value>
void print_row(const std::string& title, const char* form, const std::vector<Column>& columns,
               const Value& value) {
  fmt::print("{:<12}", title);
  for (const Column& column : columns) {
    fmt::print(" {:>8}", fmt::format(fmt::runtime(form), value(column)));
  }
  fmt::print("\n");
}

void print_table(const std::vector<Column>& columns, const std::vector<int>& ids, double noise) {
  fmt::print("\nnoise {:g}\n", noise);
  print_row("Rand error", "{}", columns, [](const Column& column) { return column.name; });
  std::size_t row = 0;
  for (const auto& [category, members] : group_by_category(ids)) {
    print_row(std::string(category_name(category)), "{:.3f}", columns,
              [row](const Column& column) { return column.categories[row]; });
    ++row;
  }
  print_row("mean", "{:.3f}", columns, [](const Column& column) { return column.rand; });
  print_row("parts", "{:.1f}", columns, [](const Column& column) { return column.parts; });
  print_row("core s", "{:.2f}", columns,
            [](const Column& column) { return column.median_seconds; });
  print_row("failed", "{}", columns, [](const Column& column) { return column.failed; });
  for (const Column& column : columns) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const std::string& error = column.results[i].error;
      if (!error.empty()) fmt::print("{}, model {}: {}\n", column.name, ids[i], error);
    }
  }
}

ordered_json column_to_json(const Column& column, const std::vector<int>& ids) {
  ordered_json object = {{"name", column.name},
                         {"rand", column.rand},
                         {"parts", column.parts},
                         {"median_core_seconds", column.median_seconds},
                         {"failed", column.failed}};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Result& result = column.results[i];
    ordered_json model = {{"id", ids[i]},
                          {"rand", result.rand},
                          {"parts", result.parts},
                          {"core_seconds", result.core_seconds}};
    if (!result.error.empty()) model["error"] = result.error;
    object["models"].push_back(model);
  }
  return object;
}

// ---- the run ----

ordered_json peers_head(const Options& options) {
  ordered_json report = report_head("peers", options.run);
  report["sdf"] = {{"clusters", options.sdf.clusters}, {"smoothing", options.sdf.smoothing}};
  report["supervoxels"] = {{"voxel", options.supervoxels.voxel},
                           {"supervoxel", options.supervoxels.supervoxel},
                           {"concavity", options.supervoxels.concavity},
                           {"common_convex", options.supervoxels.common_convex},
                           {"sanity", options.supervoxels.sanity},
                           {"smallest", options.supervoxels.smallest},
                           {"cut_score", options.supervoxels.cut_score}};
  report["tomato"] = {{"neighbors", options.tomato.neighbors},
                      {"density_neighbors", options.tomato.density_neighbors},
                      {"prominence", options.tomato.prominence}};
  return report;
}

void run(const Options& options) {
  const std::vector<Model> models = options.run.models();
  const std::vector<Contender> contenders = find_contenders(options);
  std::vector<int> ids;
  for (const Model& model : models) ids.push_back(model.id);
  ordered_json report = peers_head(options);
  for (const double noise : options.run.noise_levels()) {
    const CloudOptions cloud = options.run.cloud(noise);
    const std::vector<Outcome> outcomes =
        run_isolated(models.size() * contenders.size(), options.run.threads, [&](std::size_t job) {
          return evaluate(models[job / contenders.size()], contenders[job % contenders.size()],
                          cloud);
        });
    std::vector<Column> columns;
    ordered_json entry = {{"noise", noise}};
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      std::vector<Result> results;
      for (std::size_t i = c; i < outcomes.size(); i += contenders.size()) {
        results.push_back(result_of(outcomes[i]));
      }
      columns.push_back(column_of(contenders[c].name, std::move(results), ids));
      entry["contenders"].push_back(column_to_json(columns.back(), ids));
    }
    print_table(columns, ids, noise);
    report["runs"].push_back(entry);
  }
  if (!options.run.json.empty()) write_json(options.run.json, report);
}

void add_peer_options(CLI::App& command, Options& options) {
  const auto add = [&](const char* name, auto& value, const char* text) {
    command.add_option(name, value, text)->capture_default_str();
  };
  add("--sdf-clusters", options.sdf.clusters, "SDF: levels of thickness");
  add("--sdf-smoothing", options.sdf.smoothing, "SDF: weight of short cuts");
  add("--voxel", options.supervoxels.voxel, "LCCP, CPC: share of the diagonal");
  add("--supervoxel", options.supervoxels.supervoxel, "LCCP, CPC: distance of seeds, likewise");
  add("--concavity", options.supervoxels.concavity, "LCCP, CPC: degrees that count as convex");
  add("--common-convex", options.supervoxels.common_convex,
      "LCCP, CPC: common neighbours to which both of a convex pair are convex");
  add("--sanity", options.supervoxels.sanity,
      "LCCP, CPC: pairs that touch at a point do not count as convex");
  add("--smallest", options.supervoxels.smallest, "LCCP, CPC: supervoxels of a part, at least");
  add("--cut-score", options.supervoxels.cut_score, "CPC: least score of a cut");
  add("--tomato-neighbors", options.tomato.neighbors, "ToMATo: of the graph");
  add("--tomato-density", options.tomato.density_neighbors, "ToMATo: neighbours of the density");
  add("--tomato-prominence", options.tomato.prominence, "ToMATo: of a cluster's peak");
}

}  // namespace

void add_peers(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("peers", "Compares our parts and those of others with people's");
  add_run_options(*command, options->run);
  command->add_option("--only", options->only, "Of morsel, paper, SDF, LCCP, CPC, ToMATo")
      ->delimiter(',');
  add_peer_options(*command, *options);
  command->footer(
      "CGAL's segmentation by the shape diameter function gets the clean mesh, all others the\n"
      "same points. PCL's LCCP and CPC take part where libpcl-dev was there at build time, "
      "GUDHI's\n"
      "ToMATo where python3-gudhi and python3-scipy are. Seconds on the core, median over models.\n"
      "Each run has a process of its own; one that fails counts as error 1.");
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
