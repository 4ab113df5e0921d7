#include "curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/threads.hpp"
#include "summary.hpp"

namespace morsel::reproduce {
namespace {

using nlohmann::ordered_json;

constexpr std::uint64_t kOtherSample = 2;

// Which stored shape each query is: the first members of each family.
std::vector<std::size_t> stored_places(const Collection& stored, std::size_t members) {
  const std::size_t families = solids::family_names().size();
  const std::size_t stored_members = stored.size() / families;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < families * members; ++i) {
    places.push_back(i / members * stored_members + i % members);
  }
  return places;
}

ordered_json level_json(const Sampling& sampling, const Collection& stored, std::size_t members) {
  const std::vector<Described> queries = describe_all(make_members(members, sampling));
  std::vector<double> ours;
  std::vector<double> rules;
  std::size_t solid = 0;
  std::size_t rules_solid = 0;
  for (const Described& d : queries) {
    ours.push_back(d.error.value_or(0.0));
    rules.push_back(d.paper_error.value_or(0.0));
    if (d.solid) ++solid;
    if (!d.paper_parts.parts.empty()) ++rules_solid;
  }
  ordered_json json = {{"noise", sampling.noise},     {"outliers", sampling.outliers},
                       {"shapes", queries.size()},    {"default", bench::mean(ours)},
                       {"paper", bench::mean(rules)}, {"default_solid", solid},
                       {"paper_solid", rules_solid}};
  const std::vector<std::size_t> places = stored_places(stored, members);
  for (const Scoring& scoring : scorings()) {
    const std::vector<double> scores = score_all(scoring, queries, stored.described);
    json["retrieval"].push_back(measures_json(scoring, scores, stored.categories, places));
  }
  say(fmt::format("  noise {:g}, outliers {:g}: Rand error {:.3f}, paper's rules {:.3f}",
                  sampling.noise, sampling.outliers, bench::mean(ours), bench::mean(rules)));
  return json;
}

// Mean Rand error, and how many shapes had parts at all.
struct Errors {
  double mean = 0.0;
  std::size_t solid = 0;
};

Errors errors_of(const std::vector<Shape>& shapes, const SegmentOptions& options) {
  std::vector<double> errors(shapes.size());
  std::vector<char> solid(shapes.size());
  parallel_rows(shapes.size(), 0, [&](std::size_t i) {
    const Segmentation s = segment(shapes[i].points, options);
    errors[i] = *rand_error_of(s.labels, shapes[i]);
    solid[i] = s.verdict == Verdict::kSolid ? 1 : 0;
  });
  return {bench::mean(errors), static_cast<std::size_t>(std::ranges::count(solid, 1))};
}

ordered_json ratio_curve(const std::vector<Shape>& shapes, double angle, bool quick) {
  ordered_json curve = {{"angle", angle}};
  for (const double rho : {0.25, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0}) {
    if (quick && rho != 0.5 && rho != 3.0) continue;
    SegmentOptions options = paper_options();
    options.interior.big_ball_ratio = rho;
    options.interior.deep_angle = angle;
    const Errors errors = errors_of(shapes, options);
    curve["values"].push_back({{"rho", rho}, {"error", errors.mean}, {"solid", errors.solid}});
  }
  return curve;
}

constexpr std::array<double, 11> kMergeRatios{1.0, 1.05, 1.1, 1.2, 1.3, 1.4,
                                              1.5, 1.75, 2.0, 2.5, 3.0};

// One segmentation a shape, cut at every ratio.
ordered_json merge_curve(const std::vector<Shape>& shapes, const std::string& name,
                         const SegmentOptions& options) {
  std::vector<std::array<double, kMergeRatios.size()>> errors(shapes.size());
  parallel_rows(shapes.size(), 0, [&](std::size_t i) {
    const Segmentation s = segment(shapes[i].points, options);
    for (std::size_t k = 0; k < kMergeRatios.size(); ++k) {
      CutOptions at;
      at.merge_ratio = kMergeRatios[k];
      const bool solid = s.verdict == Verdict::kSolid;
      const std::vector<int> labels = solid ? cut(s.tree, at).part_of_point : s.labels;
      errors[i][k] = *rand_error_of(labels, shapes[i]);
    }
  });
  ordered_json curve = {{"name", name}};
  for (std::size_t k = 0; k < kMergeRatios.size(); ++k) {
    double sum = 0.0;
    for (const auto& row : errors) sum += row[k];
    curve["values"].push_back(
        {{"ratio", kMergeRatios[k]}, {"error", sum / static_cast<double>(shapes.size())}});
  }
  return curve;
}

void keep_heaviest(Signature& signature, std::size_t count) {
  if (signature.parts.size() <= count) return;
  signature.parts.resize(count);
  for (SignaturePart& part : signature.parts) {
    std::erase_if(part.neighbors,
                  [&](const PartNeighbor& n) { return n.part >= static_cast<int>(count); });
  }
}

}  // namespace

ordered_json disturbance_curves(const Study& study, const Collection& generated) {
  const std::size_t members = study.amount(2, 1);
  const std::size_t points = study.shape_points();
  ordered_json json;
  for (const double noise : {0.0, 0.0025, 0.005, 0.01, 0.015, 0.02}) {
    if (study.options.quick && noise != 0.0 && noise != 0.005) continue;
    json["noise"].push_back(
        level_json({.points = points, .noise = noise, .seed = kOtherSample}, generated, members));
  }
  for (const double outliers : {0.0, 0.01, 0.05, 0.1}) {
    if (study.options.quick && outliers != 0.0 && outliers != 0.05) continue;
    json["outliers"].push_back(level_json(
        {.points = points, .outliers = outliers, .seed = kOtherSample}, generated, members));
  }
  return json;
}

ordered_json parameter_curves(const Study& study) {
  const std::vector<Shape> shapes =
      make_members(study.amount(2, 1), {.points = study.shape_points(), .seed = kOtherSample});
  const bool quick = study.options.quick;
  ordered_json json = {{"shapes", shapes.size()}};
  for (const double angle : {10.0, 60.0}) {
    if (quick && angle != 10.0) continue;
    json["rho"].push_back(ratio_curve(shapes, angle, quick));
  }
  json["default"] = errors_of(shapes, default_options()).mean;
  json["merge"].push_back(merge_curve(shapes, "paper", paper_options()));
  json["merge"].push_back(merge_curve(shapes, "default", default_options()));
  return json;
}

ordered_json point_curve(const Study& study, const Collection& generated) {
  ordered_json curve = ordered_json::array();
  const std::vector<std::size_t> all = all_of(generated.size());
  for (const std::size_t count : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U}) {
    if (study.options.quick && count % 4 != 0) continue;
    std::vector<Described> cut_down = generated.described;
    for (Described& d : cut_down) {
      keep_heaviest(d.signature, count);
      keep_heaviest(d.paper_signature, count);
    }
    ordered_json row = {{"points", count}};
    for (const std::size_t k : {kPaperOurParts, kPaperScore}) {
      const std::vector<double> scores = score_all(scorings()[k], cut_down, cut_down);
      row["scorings"].push_back(measures_json(scorings()[k], scores, generated.categories, all));
    }
    curve.push_back(std::move(row));
  }
  return curve;
}

}  // namespace morsel::reproduce
