// morsel-bench segmentation: the parts against people's.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "levels.hpp"
#include "measures.hpp"
#include "sampling.hpp"
#include "summary.hpp"

namespace morsel::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t kPictureWidth = 160;
constexpr std::size_t kSheetColumns = 10;
// The best and the worst, enlarged.
constexpr std::size_t kExtremes = 10;
constexpr std::size_t kLargeWidth = 320;
constexpr std::size_t kLargeColumns = 5;

struct Options {
  RunOptions run;
  bool parts_told = false;
  fs::path sheet;
};

struct Result {
  int id = 0;
  Scores scores;
  std::size_t parts = 0;
  double people_parts = 0.0;  // mean over people
  std::string verdict;
  double volume_ratio = 0.0;  // inner volume over the mesh's
  int denoise_rounds = 0;
  double seconds = 0.0;  // of segment() alone
  std::string error;     // why there is no result; the scores are then 1
  Image picture;
  Image large;
};

json image_to_json(const Image& image) {
  return {{"width", image.width}, {"height", image.height}, {"rgb", json::binary(image.rgb)}};
}

Image image_from_json(const json& object) {
  Image image;
  image.width = object.at("width").get<std::size_t>();
  image.height = object.at("height").get<std::size_t>();
  image.rgb = object.at("rgb").get_binary();
  return image;
}

json scores_to_json(const Scores& scores) {
  json object;
  for (std::size_t m = 0; m < kMeasureCount; ++m) {
    object[std::string(kMeasureNames[m])] = scores[m] ? json(*scores[m]) : json(nullptr);
  }
  return object;
}

Scores scores_from_json(const json& object) {
  Scores scores;
  for (std::size_t m = 0; m < kMeasureCount; ++m) {
    const json& value = object.at(std::string(kMeasureNames[m]));
    if (!value.is_null()) scores[m] = value.get<double>();
  }
  return scores;
}

// What comes back from the child process that did the work.
json to_json(const Result& result) {
  return {{"scores", scores_to_json(result.scores)},
          {"parts", result.parts},
          {"people_parts", result.people_parts},
          {"verdict", result.verdict},
          {"volume_ratio", result.volume_ratio},
          {"denoise_rounds", result.denoise_rounds},
          {"seconds", result.seconds},
          {"picture", image_to_json(result.picture)},
          {"large", image_to_json(result.large)}};
}

Result result_of(const Model& model, const Outcome& outcome) {
  Result result;
  result.id = model.id;
  if (!outcome.error.empty()) {
    result.scores.fill(1.0);
    result.verdict = "error";
    result.error = outcome.error;
    return result;
  }
  const json& value = outcome.value;
  result.scores = scores_from_json(value.at("scores"));
  result.parts = value.at("parts").get<std::size_t>();
  result.people_parts = value.at("people_parts").get<double>();
  result.verdict = value.at("verdict").get<std::string>();
  result.volume_ratio = value.at("volume_ratio").get<double>();
  result.denoise_rounds = value.at("denoise_rounds").get<int>();
  result.seconds = value.at("seconds").get<double>();
  result.picture = image_from_json(value.at("picture"));
  result.large = image_from_json(value.at("large"));
  return result;
}

double mean_part_count(const std::vector<std::vector<int>>& people) {
  double sum = 0.0;
  for (const auto& labels : people) sum += static_cast<double>(count_labels(labels));
  return sum / static_cast<double>(people.size());
}

// The default cut, or another one of the same merge tree.
std::pair<std::vector<int>, std::size_t> choose_cut(const Segmentation& segmentation,
                                                    std::optional<std::size_t> told) {
  if (!told || segmentation.verdict != Verdict::kSolid) {
    return {segmentation.labels, segmentation.parts.parts.size()};
  }
  const Parts parts = cut(segmentation.tree, {.parts = told, .merge_ratio = std::nullopt});
  return {parts.part_of_point, parts.parts.size()};
}

Result evaluate(const Model& model, const Options& options, double noise) {
  const TriangleMesh mesh = read_mesh(model.mesh);
  const auto people = read_people(model, mesh.triangles.size());
  const Cloud cloud = sample_cloud(mesh, model.id, options.run.cloud(noise));

  const auto start = std::chrono::steady_clock::now();
  const Segmentation segmentation = segment(cloud.points, options.run.segment());
  const auto end = std::chrono::steady_clock::now();

  Result result;
  result.id = model.id;
  result.people_parts = mean_part_count(people);
  std::optional<std::size_t> told;
  if (options.parts_told) told = static_cast<std::size_t>(std::lround(result.people_parts));
  const auto [labels, parts] = choose_cut(segmentation, told);
  result.scores = compare_with_people(mesh, face_labels(mesh, cloud, labels), people);
  result.parts = parts;
  result.verdict = verdict_name(segmentation.verdict);
  const double volume = std::abs(signed_volume(mesh));
  result.volume_ratio = volume > 0.0 ? segmentation.interior.volume / volume : 0.0;
  result.denoise_rounds = segmentation.denoised.rounds;
  result.seconds = std::chrono::duration<double>(end - start).count();
  if (!options.sheet.empty()) {
    const auto draw = [&, &own = labels](std::size_t width) {
      return render_parts(cloud.points, own, {.width = width, .views = 1, .title = {}});
    };
    result.picture = draw(kPictureWidth);
    result.large = draw(kLargeWidth);
  }
  return result;
}

// ---- tables ----

struct CategoryRow {
  int category = 0;
  std::size_t models = 0;
  Scores scores;
  double parts = 0.0;
  double people_parts = 0.0;
};

struct Summary {
  std::vector<CategoryRow> categories;
  Scores mean;  // over categories
  std::size_t worst = 0;
  std::size_t not_solid = 0;
  std::size_t errors = 0;
  double median_seconds = 0.0;
};

CategoryRow summarize_category(int category, const std::vector<std::size_t>& members,
                               const std::vector<Result>& results) {
  CategoryRow row{.category = category, .models = members.size(), .scores = {}};
  std::vector<Scores> scores;
  for (const std::size_t i : members) {
    scores.push_back(results[i].scores);
    row.parts += static_cast<double>(results[i].parts) / static_cast<double>(members.size());
    row.people_parts += results[i].people_parts / static_cast<double>(members.size());
  }
  row.scores = mean_scores(scores);
  return row;
}

Summary summarize(const std::vector<Result>& results) {
  Summary summary;
  std::vector<int> ids;
  std::vector<double> seconds;
  for (const Result& result : results) {
    ids.push_back(result.id);
    if (!result.error.empty()) {
      ++summary.errors;
      continue;
    }
    seconds.push_back(result.seconds);
    if (result.verdict != "solid") ++summary.not_solid;
  }
  std::vector<Scores> scores;
  for (const auto& [category, members] : group_by_category(ids)) {
    summary.categories.push_back(summarize_category(category, members, results));
    scores.push_back(summary.categories.back().scores);
    const std::size_t last = scores.size() - 1;
    if (scores[last][kRand].value() > scores[summary.worst][kRand].value()) summary.worst = last;
  }
  summary.mean = mean_scores(scores);
  summary.median_seconds = median(std::move(seconds));
  return summary;
}

std::string cells(const Scores& scores) {
  std::string text;
  for (const auto& score : scores) {
    text += score ? fmt::format(" {:7.4f}", *score) : fmt::format(" {:>7}", "-");
  }
  return text;
}

void print_table(const std::vector<Result>& results, const Summary& summary, double noise) {
  fmt::print("\nnoise {:g}\n", noise);
  fmt::print("{:<10} {:>6} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>6} {:>6}\n", "category",
             "models", "Rand", "cut", "Hamming", "missing", "false", "GCE", "LCE", "parts",
             "people");
  for (const CategoryRow& row : summary.categories) {
    fmt::print("{:<10} {:>6}{} {:6.1f} {:6.1f}\n", category_name(row.category), row.models,
               cells(row.scores), row.parts, row.people_parts);
  }
  const CategoryRow& worst = summary.categories[summary.worst];
  fmt::print("{:<10} {:>6}{}\n", "mean", results.size(), cells(summary.mean));
  fmt::print("worst category {} {:.4f}; {} not solid, {} errors; {:.3f} s a model (median)\n",
             category_name(worst.category), worst.scores[kRand].value(), summary.not_solid,
             summary.errors, summary.median_seconds);
  for (const Result& result : results) {
    if (!result.error.empty()) fmt::print("model {}: {}\n", result.id, result.error);
  }
}

// ---- files ----

ordered_json model_to_json(const Result& result) {
  ordered_json object;
  object["id"] = result.id;
  object["category"] = category_name(category_of(result.id));
  object.update(scores_to_json(result.scores));
  object["parts"] = result.parts;
  object["people_parts"] = result.people_parts;
  object["verdict"] = result.verdict;
  object["volume_ratio"] = result.volume_ratio;
  object["denoise_rounds"] = result.denoise_rounds;
  object["seconds"] = result.seconds;
  if (!result.error.empty()) object["error"] = result.error;
  return object;
}

ordered_json run_to_json(const std::vector<Result>& results, const Summary& summary, double noise) {
  ordered_json run;
  run["noise"] = noise;
  run["mean"] = scores_to_json(summary.mean);
  const CategoryRow& worst = summary.categories[summary.worst];
  run["worst_category"] = {{"name", category_name(worst.category)},
                           {"rand", worst.scores[kRand].value()}};
  run["not_solid"] = summary.not_solid;
  run["errors"] = summary.errors;
  run["median_seconds"] = summary.median_seconds;
  for (const CategoryRow& row : summary.categories) {
    ordered_json category = {{"name", category_name(row.category)}, {"models", row.models}};
    category.update(scores_to_json(row.scores));
    category["parts"] = row.parts;
    category["people_parts"] = row.people_parts;
    run["categories"].push_back(category);
  }
  for (const Result& result : results) run["models"].push_back(model_to_json(result));
  return run;
}

void write_pictures(const fs::path& path, std::span<const Result> results, Image Result::*picture,
                    std::size_t columns) {
  std::vector<Image> pictures;
  std::vector<std::string> captions;
  for (const Result& result : results) {
    pictures.push_back(result.*picture);
    captions.push_back(fmt::format("{} {:.3f}", result.id, result.scores[kRand].value()));
  }
  if (!pictures.empty()) write_png(path, make_sheet(pictures, captions, columns));
}

// All models in order, and the best and the worst. With several noise levels, the level goes into
// the name.
void write_sheets(const Options& options, std::vector<Result> results, double noise) {
  std::erase_if(results, [](const Result& result) { return !result.error.empty(); });
  std::string name = options.sheet.stem().string();
  if (options.run.noise_levels().size() > 1) name += fmt::format("-{:g}", noise);
  const auto path = [&](const std::string& suffix) {
    return options.sheet.parent_path() / (name + suffix + options.sheet.extension().string());
  };
  write_pictures(path(""), results, &Result::picture, kSheetColumns);
  std::ranges::stable_sort(results, {}, [](const Result& r) { return r.scores[kRand].value(); });
  const std::size_t count = std::min(kExtremes, results.size());
  const auto all = std::span<const Result>(results);
  write_pictures(path("-best"), all.first(count), &Result::large, kLargeColumns);
  write_pictures(path("-worst"), all.last(count), &Result::large, kLargeColumns);
}

ordered_json report_level(const Options& options, const std::vector<Model>& models,
                          const std::vector<Outcome>& outcomes, double noise) {
  std::vector<Result> results;
  for (std::size_t i = 0; i < models.size(); ++i) {
    results.push_back(result_of(models[i], outcomes[i]));
  }
  const Summary summary = summarize(results);
  print_table(results, summary, noise);
  if (!options.sheet.empty()) write_sheets(options, results, noise);
  return run_to_json(results, summary, noise);
}

void run(const Options& options) {
  ordered_json report = report_head("segmentation", options.run);
  report["options"]["parts_told"] = options.parts_told;
  const auto evaluate_one = [&](const Model& model, double noise) {
    return to_json(evaluate(model, options, noise));
  };
  const auto report_one = [&](const auto& models, const auto& outcomes, double noise) {
    return report_level(options, models, outcomes, noise);
  };
  run_levels(options.run, std::move(report), evaluate_one, report_one);
}

}  // namespace

void add_segmentation(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "segmentation", "Compares the parts of sampled meshes with people's segmentations");
  add_run_options(*command, options->run);
  command->add_flag("--parts-told", options->parts_told,
                    "Cut into the rounded mean of people's part counts");
  command->add_option(
      "--sheet", options->sheet,
      "Draw all models with their parts into a PNG, and the best and worst ten enlarged "
      "into NAME-best and NAME-worst beside it");
  command->footer(
      "All measures are errors between 0 (equal) and about 1, means over people, then models of a\n"
      "category, then categories. Every face counts the same. The cut discrepancy is taken "
      "between\n"
      "midpoints of cut edges in a straight line; a person or result without cuts is left out of "
      "it.\n"
      "A model without an inside counts as one part; one that crashes counts as error 1.");
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
