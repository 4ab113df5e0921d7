// morsel-bench interior: the inner volume against the mesh's.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "levels.hpp"
#include "sampling.hpp"
#include "summary.hpp"

namespace morsel::bench {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t kWorstListed = 10;
constexpr double kFarShort = 0.7;

struct Result {
  int id = 0;
  double ratio = 0.0;  // inner volume over the mesh's; 0 when something went wrong
  std::string verdict;
  std::string error;

  [[nodiscard]] double volume_error() const { return std::abs(ratio - 1.0); }
};

json evaluate(const Model& model, const RunOptions& options, double noise) {
  const TriangleMesh mesh = read_mesh(model.mesh);
  const double volume = std::abs(signed_volume(mesh));
  if (!(volume > 0.0)) {
    throw Error(ErrorCode::kInput, fmt::format("{}: the mesh has no volume", model.mesh.string()));
  }
  const Cloud cloud = sample_cloud(mesh, model.id, options.cloud(noise));
  const Segmentation segmentation = segment(cloud.points, options.segment());
  return {{"ratio", segmentation.interior.volume / volume},
          {"verdict", verdict_name(segmentation.verdict)}};
}

Result result_of(const Model& model, const Outcome& outcome) {
  if (!outcome.error.empty()) {
    return {.id = model.id, .ratio = 0.0, .verdict = "error", .error = outcome.error};
  }
  return {.id = model.id,
          .ratio = outcome.value.at("ratio").get<double>(),
          .verdict = outcome.value.at("verdict").get<std::string>(),
          .error = {}};
}

struct Summary {
  double median_error = 0.0;
  std::size_t within_3_percent = 0;
  std::size_t within_10_percent = 0;
  std::size_t far_short = 0;
  std::size_t errors = 0;
  struct Category {
    int category = 0;
    std::size_t models = 0;
    double mean_ratio = 0.0;
    double mean_error = 0.0;
  };
  std::vector<Category> categories;
};

Summary::Category summarize_category(int category, const std::vector<std::size_t>& members,
                                     const std::vector<Result>& results) {
  std::vector<double> ratios;
  std::vector<double> errors;
  for (const std::size_t i : members) {
    ratios.push_back(results[i].ratio);
    errors.push_back(results[i].volume_error());
  }
  return {.category = category,
          .models = members.size(),
          .mean_ratio = mean(ratios),
          .mean_error = mean(errors)};
}

Summary summarize(const std::vector<Result>& results) {
  Summary summary;
  std::vector<int> ids;
  std::vector<double> errors;
  for (const Result& result : results) {
    ids.push_back(result.id);
    errors.push_back(result.volume_error());
    if (result.volume_error() <= 0.03) ++summary.within_3_percent;
    if (result.volume_error() <= 0.10) ++summary.within_10_percent;
    if (result.ratio < kFarShort) ++summary.far_short;
    if (!result.error.empty()) ++summary.errors;
  }
  summary.median_error = median(std::move(errors));
  for (const auto& [category, members] : group_by_category(ids)) {
    summary.categories.push_back(summarize_category(category, members, results));
  }
  return summary;
}

std::vector<Result> worst_first(std::vector<Result> results) {
  std::stable_sort(results.begin(), results.end(), [](const Result& a, const Result& b) {
    return a.volume_error() > b.volume_error();
  });
  return results;
}

void print_table(const std::vector<Result>& results, const Summary& summary, double noise) {
  fmt::print("\nnoise {:g}\n{:<10} {:>6} {:>8} {:>8}\n", noise, "category", "models", "volume",
             "error");
  for (const auto& row : summary.categories) {
    fmt::print("{:<10} {:>6} {:7.2f}% {:7.2f}%\n", category_name(row.category), row.models,
               100.0 * row.mean_ratio, 100.0 * row.mean_error);
  }
  fmt::print(
      "median error {:.2f}%; of {} models {} within 3%, {} within 10%, {} below 70%, {} errors\n",
      100.0 * summary.median_error, results.size(), summary.within_3_percent,
      summary.within_10_percent, summary.far_short, summary.errors);
  const auto worst = worst_first(results);
  fmt::print("worst:\n");
  for (std::size_t i = 0; i < std::min(kWorstListed, worst.size()); ++i) {
    fmt::print("  {:>4} {:<10} {:7.2f}% {}{}{}\n", worst[i].id,
               category_name(category_of(worst[i].id)), 100.0 * worst[i].ratio, worst[i].verdict,
               worst[i].error.empty() ? "" : ": ", worst[i].error);
  }
}

ordered_json run_to_json(const std::vector<Result>& results, const Summary& summary, double noise) {
  ordered_json run = {{"noise", noise},
                      {"median_error", summary.median_error},
                      {"models_total", results.size()},
                      {"within_3_percent", summary.within_3_percent},
                      {"within_10_percent", summary.within_10_percent},
                      {"below_70_percent", summary.far_short},
                      {"errors", summary.errors}};
  for (const auto& row : summary.categories) {
    run["categories"].push_back({{"name", category_name(row.category)},
                                 {"models", row.models},
                                 {"mean_ratio", row.mean_ratio},
                                 {"mean_error", row.mean_error}});
  }
  for (const Result& result : results) {
    ordered_json model = {{"id", result.id},
                          {"category", category_name(category_of(result.id))},
                          {"ratio", result.ratio},
                          {"verdict", result.verdict}};
    if (!result.error.empty()) model["error"] = result.error;
    run["models"].push_back(model);
  }
  return run;
}

ordered_json report_level(const std::vector<Model>& models, const std::vector<Outcome>& outcomes,
                          double noise) {
  std::vector<Result> results;
  for (std::size_t i = 0; i < models.size(); ++i) {
    results.push_back(result_of(models[i], outcomes[i]));
  }
  const Summary summary = summarize(results);
  print_table(results, summary, noise);
  return run_to_json(results, summary, noise);
}

void run(const RunOptions& options) {
  const auto evaluate_one = [&](const Model& model, double noise) {
    return evaluate(model, options, noise);
  };
  run_levels(options, report_head("interior", options), evaluate_one, report_level);
}

}  // namespace

void add_interior(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      app.add_subcommand("interior", "Compares the inner volume of sampled meshes with the mesh's");
  add_run_options(*command, *options);
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
