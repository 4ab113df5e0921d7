// morsel-bench retrieval: do shapes of one class find each other?
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>

#include "base/random.hpp"
#include "collection.hpp"
#include "commands.hpp"
#include "isolated.hpp"
#include "match/paper.hpp"
#include "ranking.hpp"
#include "run_options.hpp"
#include "sampling.hpp"
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
  double diagonal = 1.0;  // of the axis-aligned box in the shape's random pose
  double triangulate_seconds = 0.0;
  double signature_seconds = 0.0;
  std::string error;
};

// Pose and scale of a shape; half of the shapes are mirrored.
std::vector<Vec3> posed(std::vector<Vec3> points, std::uint64_t seed) {
  constexpr std::uint64_t kPoseStream = 0x706f7365ULL;
  Random random(seed ^ kPoseStream);
  const auto direction = [&random] {
    const double x = random.normal();
    const double y = random.normal();
    const Vec3 v{x, y, random.normal()};
    return (1.0 / norm(v)) * v;
  };
  const Vec3 a = direction();
  const Vec3 across = cross(a, direction());
  const Vec3 b = (1.0 / norm(across)) * across;
  const Vec3 c = (random.below(2) == 0 ? 1.0 : -1.0) * cross(a, b);
  const double scale = std::exp(4.0 * random.uniform() - 2.0);
  const Vec3 shift = 10.0 * direction();
  for (Vec3& p : points) p = scale * Vec3{dot(a, p), dot(b, p), dot(c, p)} + shift;
  return points;
}

double box_diagonal(const std::vector<Vec3>& points) {
  Vec3 low = points.front();
  Vec3 high = low;
  for (const Vec3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return distance(low, high);
}

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
  const auto began = std::chrono::steady_clock::now();
  const Signature signature = make_signature(s, 1);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - began;
  return {{"signature", to_json(signature)},
          {"d2", d2_distribution(points, {.threads = 1})},
          {"diagonal", box_diagonal(points)},
          {"triangulate", seconds_of(s, "triangulate")},
          {"signature_seconds", taken.count()}};
}

Described described_of(const Outcome& outcome) {
  Described result;
  result.error = outcome.error;
  if (!result.error.empty()) return result;
  result.signature = signature_from_json(outcome.value.at("signature").get<std::string>());
  result.d2 = outcome.value.at("d2").get<std::vector<double>>();
  result.diagonal = outcome.value.at("diagonal").get<double>();
  result.triangulate_seconds = outcome.value.at("triangulate").get<double>();
  result.signature_seconds = outcome.value.at("signature_seconds").get<double>();
  return result;
}

struct Scoring {
  const char* name;
  std::function<double(const Described&, const Described&)> score;
};

std::vector<Scoring> methods() {
  const auto literal = [](const Described& a, const Described& b) {
    return literal_paper_score(a.signature, b.signature, a.signature.size / a.diagonal,
                               b.signature.size / b.diagonal);
  };
  const auto d2 = [](const Described& a, const Described& b) {
    return a.d2.size() == b.d2.size() ? -d2_distance(a.d2, b.d2) : -2.0;
  };
  return {{"morsel", [](const Described& a,
                        const Described& b) { return match_score(a.signature, b.signature); }},
          {"paper",
           [](const Described& a, const Described& b) {
             return match_score(a.signature, b.signature, {.method = Method::kPaper});
           }},
          {"paper, literally", literal},
          {"D2", d2}};
}

std::vector<double> score_matrix(const Scoring& method, const std::vector<Described>& queries,
                                 const std::vector<Described>& stored) {
  std::vector<double> scores;
  scores.reserve(queries.size() * stored.size());
  for (const Described& query : queries) {
    for (const Described& shape : stored) scores.push_back(method.score(query, shape));
  }
  return scores;
}

void print_and_add(const std::string& title, const std::vector<Described>& queries,
                   const std::vector<Described>& stored, const std::vector<std::string>& categories,
                   ordered_json& report) {
  fmt::print("\n{}\n{:<18} {:>6} {:>6} {:>6} {:>6}\n", title, "score", "NN", "FT", "ST", "DCG");
  for (const Scoring& method : methods()) {
    const Retrieval r = rank(score_matrix(method, queries, stored), categories);
    fmt::print("{:<18} {:6.3f} {:6.3f} {:6.3f} {:6.3f}\n", method.name, r.nearest, r.first_tier,
               r.second_tier, r.gain);
    report["runs"].push_back({{"run", title},
                              {"score", method.name},
                              {"nearest_neighbor", r.nearest},
                              {"first_tier", r.first_tier},
                              {"second_tier", r.second_tier},
                              {"discounted_gain", r.gain}});
  }
  std::fflush(stdout);
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
  std::vector<std::string> categories;
  for (const ClassedShape& shape : shapes) categories.push_back(shape.category);
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
