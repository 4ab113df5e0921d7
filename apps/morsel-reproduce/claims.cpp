// What the paper claims beside its figures: one measurement for each claim.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/box.hpp"
#include "base/random.hpp"
#include "base/threads.hpp"
#include "curves.hpp"
#include "describe.hpp"
#include "match/paper.hpp"
#include "measures.hpp"
#include "perturb.hpp"
#include "pose.hpp"
#include "sections.hpp"
#include "stopwatch.hpp"
#include "summary.hpp"

namespace morsel::reproduce {
namespace {

using nlohmann::ordered_json;

// How far a turned, moved, mirrored and scaled copy is from its shape.
struct Deviation {
  double score = 0.0;        // of the default score from 1
  double paper_score = 0.0;  // of the paper's score from 1, our parts
  double literal = 0.0;      // of the paper's score to the letter from 1, our parts
  int table_step = 0;        // largest change of a byte of the tables
  double labels = 0.0;       // Rand error between the labels of the two
};

void take_larger(Deviation& a, const Deviation& b) {
  a.score = std::max(a.score, b.score);
  a.paper_score = std::max(a.paper_score, b.paper_score);
  a.literal = std::max(a.literal, b.literal);
  a.table_step = std::max(a.table_step, b.table_step);
  a.labels = std::max(a.labels, b.labels);
}

struct Cut {
  Signature signature;
  std::vector<int> labels;
  double unit = 1.0;  // RMS radii of the shape a diagonal of its box
};

Cut cut_of(const std::vector<Vec3>& points) {
  const Segmentation s = segment(points, default_options());
  Cut result{.signature = make_signature(s, 1), .labels = s.labels};
  result.unit = result.signature.size / bounding_box(points).diagonal();
  return result;
}

Deviation deviation_of(const Cut& a, const Cut& b) {
  Deviation d;
  d.score = 1.0 - match_score(a.signature, b.signature);
  d.paper_score = 1.0 - match_score(a.signature, b.signature, {.method = Method::kPaper});
  d.literal = 1.0 - literal_paper_score(a.signature, b.signature, a.unit, b.unit);
  for (std::size_t i = 0; i < a.signature.tables.size(); ++i) {
    d.table_step = std::max(d.table_step, std::abs(a.signature.tables[i] - b.signature.tables[i]));
  }
  d.labels = bench::rand_error(bench::count_pairs(a.labels, b.labels));
  return d;
}

ordered_json invariance(const Study& study) {
  const std::size_t shapes = study.amount(20, 2);
  const std::size_t transforms = study.amount(50, 2);
  std::vector<std::vector<Deviation>> all(shapes);
  parallel_rows(shapes, 0, [&](std::size_t i) {
    const Shape shape = make_shape({.family = i % solids::family_names().size(), .number = i},
                                   {.points = study.amount(2000, 800)});
    const Cut original = cut_of(shape.points);
    for (std::size_t k = 0; k < transforms; ++k) {
      all[i].push_back(deviation_of(original, cut_of(bench::posed(shape.points, 100 * i + k))));
    }
  });
  Deviation largest;
  std::size_t same_tables = 0;
  std::size_t same_labels = 0;
  for (const auto& row : all) {
    for (const Deviation& d : row) {
      take_larger(largest, d);
      if (d.table_step == 0) ++same_tables;
      if (d.labels == 0.0) ++same_labels;
    }
  }
  return {{"transforms", shapes * transforms},
          {"shapes", shapes},
          {"score", largest.score},
          {"paper_score", largest.paper_score},
          {"literal_score", largest.literal},
          {"table_step", largest.table_step},
          {"labels", largest.labels},
          {"same_tables", same_tables},
          {"same_labels", same_labels}};
}

// Seconds of a query: over as many signatures as the paper has, and over many more.
ordered_json query_times(const Study& study, const Collection& generated) {
  ordered_json json = ordered_json::array();
  const std::filesystem::path file = study.options.out / "signatures.block";
  Random random(1);
  for (const std::size_t count : {std::size_t{300}, study.amount(30000, 1000)}) {
    SearchBlockWriter writer(file);
    for (std::size_t i = 0; i < count; ++i) {
      const Signature& base = generated.described[i % generated.size()].signature;
      const Signature& mate = generated.described[random.below(generated.size())].signature;
      writer.add(fmt::format("{}", i), bench::perturbed(base, mate, bench::kPerturbation, random));
    }
    writer.commit();
    const SearchBlock block = SearchBlock::open(file);
    for (const Method method : {Method::kDefault, Method::kPaper}) {
      if (method == Method::kPaper && count > 1000) continue;
      std::vector<double> seconds;
      for (std::size_t q = 0; q < study.amount(40, 3); ++q) {
        const bench::Stopwatch watch;
        const auto hits = block.search(generated.described[q * 5 % generated.size()].signature, 5,
                                       {.method = method});
        seconds.push_back(watch.seconds());
      }
      json.push_back({{"signatures", count},
                      {"method", method == Method::kPaper ? "paper" : "default"},
                      {"median_seconds", bench::median(seconds)},
                      {"worst_seconds", *std::ranges::max_element(seconds)}});
    }
  }
  std::filesystem::remove(file);
  return json;
}

// The same figure in two poses, beside two figures of one class.
ordered_json poses(const Study& study) {
  const Sampling sampling{.points = study.shape_points()};
  Sampling other = sampling;
  other.seed = 2;
  std::vector<Shape> shapes;  // in turn: a figure, its other pose, another figure of its class
  const std::size_t members = study.amount(4, 1);
  for (std::size_t family = 0; family < solids::family_names().size(); ++family) {
    if (!solids::has_joints(family)) continue;
    for (std::size_t number = 0; number < members; ++number) {
      shapes.push_back(make_shape({.family = family, .number = number, .pose = 0}, sampling));
      shapes.push_back(make_shape({.family = family, .number = number, .pose = 1}, other));
      shapes.push_back(make_shape({.family = family, .number = number + 1, .pose = 2}, other));
    }
  }
  const std::vector<Described> all = describe_all(shapes);
  std::array<std::vector<double>, 2> errors;
  ordered_json json = {{"pairs", all.size() / 3}};
  for (std::size_t i = 0; i < all.size(); i += 3) {
    errors[0].push_back(*all[i].error);
    errors[1].push_back(*all[i + 1].error);
  }
  json["error"] = {bench::mean(errors[0]), bench::mean(errors[1])};
  for (const std::size_t k : {kDefaultScore, kPaperOurParts}) {
    std::vector<double> posed;
    std::vector<double> classmates;
    for (std::size_t i = 0; i < all.size(); i += 3) {
      posed.push_back(scorings()[k].score(all[i], all[i + 1]));
      classmates.push_back(scorings()[k].score(all[i], all[i + 2]));
    }
    json["scores"].push_back({{"name", scorings()[k].name},
                              {"same_figure", bench::mean(posed)},
                              {"same_class", bench::mean(classmates)}});
  }
  return json;
}

// Surfaces with boundary: what each method says to them.
ordered_json open_surfaces(const Study& study) {
  ordered_json json = ordered_json::array();
  for (const char* name : {"meshes/elephant.off", "meshes/elephant-with-holes.off",
                           "meshes/pig.off", "points_3/hippo1.ply"}) {
    const std::filesystem::path file = study.options.data / name;
    if (study.options.data.empty() || !exists(file)) continue;
    const std::vector<Vec3> points = read_points(file, {.count = study.amount(20000, 2000)}).points;
    const Segmentation ours = segment(points, default_options());
    const Segmentation rules = segment(points, paper_options());
    json.push_back({{"file", file.filename().string()},
                    {"openings", ours.interior.openings.size()},
                    {"default", bench::verdict_name(ours.verdict)},
                    {"default_parts", ours.parts.parts.size()},
                    {"paper", bench::verdict_name(rules.verdict)},
                    {"paper_parts", rules.parts.parts.size()},
                    {"paper_volume", rules.interior.volume / ours.interior.volume}});
  }
  return json;
}

// Combinatorial: the same labels whatever the threads and the order of the points.
ordered_json repeatability(const Study& study) {
  std::size_t same = 0;
  const std::size_t shapes = study.amount(17, 2);
  for (std::size_t i = 0; i < shapes; ++i) {
    const Shape shape = make_shape({.family = i}, {.points = study.amount(4000, 800)});
    SegmentOptions all_threads = default_options();
    all_threads.threads = all_threads.denoise.threads = 0;
    std::vector<Vec3> backwards(shape.points.rbegin(), shape.points.rend());
    std::vector<int> labels = segment(backwards, all_threads).labels;
    std::ranges::reverse(labels);
    if (labels == segment(shape.points, default_options()).labels) ++same;
  }
  return {{"shapes", shapes}, {"same", same}};
}

// How many parts signatures have, and bytes.
ordered_json sizes(const Collection& generated) {
  std::vector<double> ours;
  std::vector<double> rules;
  std::vector<double> truth;
  std::vector<double> bytes;
  for (std::size_t i = 0; i < generated.size(); ++i) {
    const Described& d = generated.described[i];
    ours.push_back(static_cast<double>(d.parts.parts.size()));
    rules.push_back(static_cast<double>(d.paper_parts.parts.size()));
    truth.push_back(static_cast<double>(bench::count_labels(generated.shapes[i].truth)));
    bytes.push_back(static_cast<double>(encode(d.signature).size()));
  }
  return {{"default_parts", bench::median(ours)},
          {"paper_parts", bench::median(rules)},
          {"true_parts", bench::median(truth)},
          {"bytes", bench::median(bytes)}};
}

}  // namespace

void add_claims(Study& study, const Collection& generated) {
  const auto add = [&study](const char* name, ordered_json value) {
    study.figures["claims"][name] = std::move(value);
    study.save();
  };
  add("sizes", sizes(generated));
  say("  repeatability, invariance");
  add("repeatability", repeatability(study));
  add("invariance", invariance(study));
  say("  noise and outliers");
  add("curves", disturbance_curves(study, generated));
  say("  the paper's two numbers");
  add("parameters", parameter_curves(study));
  say("  points of a signature, queries, poses, open surfaces");
  add("points", point_curve(study, generated));
  add("queries", query_times(study, generated));
  add("poses", poses(study));
  add("open", open_surfaces(study));
}

}  // namespace morsel::reproduce
