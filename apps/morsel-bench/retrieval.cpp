// morsel-bench retrieval: do shapes of one class find each other?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>

#include "base/box.hpp"
#include "collection.hpp"
#include "commands.hpp"
#include "esf.hpp"
#include "isolated.hpp"
#include "match/paper.hpp"
#include "pose.hpp"
#include "ranking.hpp"
#include "run_options.hpp"
#include "sampling.hpp"
#include "signature/tables.hpp"
#include "stopwatch.hpp"
#include "summary.hpp"

namespace morsel::bench {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct RetrievalOptions : RunOptions {
  std::filesystem::path classes;
  std::filesystem::path block;
};

// What is kept of one sampled shape.
struct Described {
  Signature signature;
  std::vector<double> d2;
  std::vector<float> esf;
  double diagonal = 1.0;  // of the axis-aligned box in the shape's random pose
  double triangulate_seconds = 0.0;
  double signature_seconds = 0.0;
  std::string error;
};

double seconds_of(const Segmentation& s, const std::string& stage) {
  for (const StageCost& cost : s.costs) {
    if (cost.stage == stage) return cost.seconds;
  }
  return 0.0;
}

json describe(const ClassedShape& shape, int id, const RetrievalOptions& options, double noise) {
  const Cloud cloud = sample_cloud(read_mesh(shape.path), id, options.cloud(noise));
  const std::vector<Vec3> points = posed(cloud.points, seed_of_model(options.seed, id));
  const Segmentation s = segment(points, options.segment());
  const Stopwatch watch;
  const Signature signature = make_signature(s, 1);
  const double taken = watch.seconds();
  return {{"signature", to_json(signature)},
          {"d2", d2_distribution(points, {.threads = 1})},
          {"esf", esf(points)},
          {"diagonal", bounding_box(points).diagonal()},
          {"triangulate", seconds_of(s, "triangulate")},
          {"signature_seconds", taken}};
}

Described described_of(const Outcome& outcome) {
  Described result;
  result.error = outcome.error;
  if (!result.error.empty()) return result;
  result.signature = signature_from_json(outcome.value.at("signature").get<std::string>());
  result.d2 = outcome.value.at("d2").get<std::vector<double>>();
  result.esf = outcome.value.at("esf").get<std::vector<float>>();
  result.diagonal = outcome.value.at("diagonal").get<double>();
  result.triangulate_seconds = outcome.value.at("triangulate").get<double>();
  result.signature_seconds = outcome.value.at("signature_seconds").get<double>();
  return result;
}

using Score = std::function<double(const Described&, const Described&)>;

struct Scoring {
  std::string name;
  Score score;
};

// The default score of some of its measures, `weight_of` each.
Score score_of(const std::function<double(const ScoreTerm&)>& weight_of) {
  return [weight_of](const Described& a, const Described& b) {
    double distance = 0.0;
    double weights = 0.0;
    for (const ScoreTerm& term : explain_score(a.signature, b.signature)) {
      distance += weight_of(term) * term.distance;
      weights += weight_of(term);
    }
    return weights > 0.0 ? std::exp(-distance / weights) : 0.0;
  };
}

// What each block is worth: the score without it, and of it alone.
void add_ablation(std::vector<Scoring>& all) {
  for (const TableBlock& block : kTableBlocks) {
    const std::string name = block.name;
    all.push_back({"  without " + name, score_of([name](const ScoreTerm& term) {
                     return term.name == name ? 0.0 : term.weight;
                   })});
  }
  all.push_back({"  without solidity", score_of([](const ScoreTerm&) { return 1.0; })});
  for (const TableBlock& block : kTableBlocks) {
    const std::string name = block.name;
    all.push_back({"  only " + name, score_of([name](const ScoreTerm& term) {
                     return term.name == name ? 1.0 : 0.0;
                   })});
  }
}

double esf_score(const Described& a, const Described& b) {
  if (a.esf.size() != b.esf.size()) return -2.0;  // the farthest that two can be apart
  double sum = 0.0;
  for (std::size_t i = 0; i < a.esf.size(); ++i) sum += std::abs(a.esf[i] - b.esf[i]);
  return -sum;
}

std::vector<Scoring> methods() {
  std::vector<Scoring> all;
  all.push_back({"morsel", [](const Described& a, const Described& b) {
                   return match_score(a.signature, b.signature);
                 }});
  add_ablation(all);
  all.push_back({"paper", [](const Described& a, const Described& b) {
                   return match_score(a.signature, b.signature, {.method = Method::kPaper});
                 }});
  all.push_back({"paper, literally", [](const Described& a, const Described& b) {
                   return literal_paper_score(a.signature, b.signature,
                                              a.signature.size / a.diagonal,
                                              b.signature.size / b.diagonal);
                 }});
  all.push_back({"D2", [](const Described& a, const Described& b) {
                   return a.d2.size() == b.d2.size() ? -d2_distance(a.d2, b.d2) : -2.0;
                 }});
  if (has_esf()) all.push_back({"ESF", esf_score});
  return all;
}

// Which shapes ask: all, and those of every other class, for how far the figures depend on them.
struct Askers {
  std::string name;
  std::vector<std::size_t> shapes;
};

std::vector<Askers> askers_of(const std::vector<std::string>& categories) {
  std::vector<Askers> all{{"all", {}}, {"odd classes", {}}, {"even classes", {}}};
  std::vector<std::string> classes;
  for (std::size_t i = 0; i < categories.size(); ++i) {
    const auto found = std::ranges::find(classes, categories[i]);
    const auto number = static_cast<std::size_t>(found - classes.begin());
    if (found == classes.end()) classes.push_back(categories[i]);
    all[0].shapes.push_back(i);
    all[1 + number % 2].shapes.push_back(i);
  }
  return all;
}

std::vector<Retrieval> rank_by(const Scoring& method, const std::vector<Described>& queries,
                               const std::vector<Described>& stored,
                               const std::vector<std::string>& categories,
                               const std::vector<Askers>& askers) {
  std::vector<Retrieval> ranked;
  std::vector<double> all;  // rows of all shapes in turn, as the first askers have them
  for (const Described& query : queries) {
    for (const Described& shape : stored) all.push_back(method.score(query, shape));
  }
  for (const Askers& some : askers) {
    std::vector<double> scores;
    for (const std::size_t i : some.shapes) {
      const auto row = all.begin() + static_cast<std::ptrdiff_t>(i * stored.size());
      scores.insert(scores.end(), row, row + static_cast<std::ptrdiff_t>(stored.size()));
    }
    ranked.push_back(rank(scores, categories, some.shapes));
  }
  return ranked;
}

void print_and_add(const std::string& title, const std::vector<Described>& queries,
                   const std::vector<Described>& stored, const std::vector<std::string>& categories,
                   ordered_json& report) {
  fmt::print("\n{:<39} DCG of classes\n{:<20}", title, "score");
  for (const char* column : {"NN", "FT", "ST", "DCG", "odd", "even"}) fmt::print("{:>7}", column);
  fmt::print("\n");
  const std::vector<Askers> askers = askers_of(categories);
  for (const Scoring& method : methods()) {
    const std::vector<Retrieval> ranked = rank_by(method, queries, stored, categories, askers);
    const Retrieval& r = ranked[0];
    fmt::print("{:<20}{:7.3f}{:7.3f}{:7.3f}{:7.3f}{:7.3f}{:7.3f}\n", method.name, r.nearest,
               r.first_tier, r.second_tier, r.gain, ranked[1].gain, ranked[2].gain);
    std::fflush(stdout);
    for (std::size_t k = 0; k < askers.size(); ++k) {
      ordered_json run = {{"run", title},
                          {"score", method.name.substr(method.name.find_first_not_of(' '))},
                          {"queries", askers[k].name}};
      add_measures(ranked[k], run);
      report["runs"].push_back(std::move(run));
    }
  }
}

void print_cost(const std::vector<Described>& shapes) {
  double triangulate = 0.0;
  double signature = 0.0;
  std::size_t errors = 0;
  for (const Described& shape : shapes) {
    triangulate += shape.triangulate_seconds;
    signature += shape.signature_seconds;
    if (!shape.error.empty()) ++errors;
  }
  fmt::print("signature stage / triangulate stage: {:.2f}; {} errors\n", signature / triangulate,
             errors);
}

void write_block(const RetrievalOptions& options, const std::vector<ClassedShape>& shapes,
                 const std::vector<Described>& described) {
  std::vector<std::string> names;
  std::vector<Signature> signatures;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    names.push_back(shapes[i].name);
    signatures.push_back(described[i].signature);
  }
  write_search_block(options.block, names, signatures);
}

void run(const RetrievalOptions& options) {
  const IdFilter filter = IdFilter::parse(options.ids);
  const std::vector<ClassedShape> shapes =
      options.classes.empty() ? list_shapes(options.folder, filter)
                              : read_classification(options.classes, options.folder);
  const std::vector<std::string> categories = categories_of(shapes);
  const std::vector<double> levels = options.noise_levels();
  const auto outcomes =
      run_isolated(shapes.size() * levels.size(), options.threads, [&](std::size_t job) {
        const std::size_t i = job % shapes.size();
        return describe(shapes[i], static_cast<int>(i), options, levels[job / shapes.size()]);
      });

  ordered_json report = report_head("retrieval", options);
  report["shapes"] = shapes.size();
  std::vector<Described> clean;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    std::vector<Described> described;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      described.push_back(described_of(outcomes[level * shapes.size() + i]));
    }
    print_and_add(fmt::format("noise {:g}", levels[level]), described, described, categories,
                  report);
    print_cost(described);
    if (levels[level] == 0.0) {
      clean = described;
    } else if (!clean.empty()) {
      print_and_add(fmt::format("noise {:g} against noise 0", levels[level]), described, clean,
                    categories, report);
    }
    if (level == 0 && !options.block.empty()) write_block(options, shapes, described);
  }
  if (!options.json.empty()) write_json(options.json, report);
}

}  // namespace

void add_retrieval(CLI::App& app) {
  auto options = std::make_shared<RetrievalOptions>();
  CLI::App* command = app.add_subcommand(
      "retrieval", "Ranks shapes by their likeness, each in a random pose, scale and mirroring");
  add_run_options(*command, *options);
  command
      ->add_option("--classes", options->classes,
                   "Classification file of the Princeton Shape Benchmark (.cla); DIR holds mN.off")
      ->check(CLI::ExistingFile);
  command->add_option("--block", options->block,
                      "Write the first noise level's signatures for morsel-bench search");
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
