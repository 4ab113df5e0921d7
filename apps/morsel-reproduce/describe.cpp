#include "describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/box.hpp"
#include "base/threads.hpp"
#include "match/paper.hpp"
#include "measures.hpp"
#include "pose.hpp"
#include "sampling.hpp"

namespace morsel::reproduce {
namespace {

Described describe(const Shape& shape) {
  Described result;
  const Segmentation ours = segment(shape.points, default_options());
  const Segmentation papers = segment(shape.points, paper_options());
  result.solid = ours.verdict == Verdict::kSolid;
  result.signature = make_signature(ours, 1);
  result.paper_signature = make_signature(papers, 1);
  result.labels = ours.labels;
  result.parts = ours.parts;
  result.paper_parts = papers.parts;
  result.error = rand_error_of(ours.labels, shape);
  result.paper_error = rand_error_of(papers.labels, shape);
  result.d2 = d2_distribution(shape.points, {.threads = 1});
  result.diagonal = bounding_box(shape.points).diagonal();
  return result;
}

double literal_score(const Described& a, const Described& b) {
  return literal_paper_score(a.paper_signature, b.paper_signature,
                             a.paper_signature.size / a.diagonal,
                             b.paper_signature.size / b.diagonal);
}

}  // namespace

SegmentOptions paper_options() {
  SegmentOptions options = default_options();
  options.interior.method = Method::kPaper;
  options.interior.big_ball_ratio = 0.5;
  options.interior.deep_angle = 10.0;
  return options;
}

SegmentOptions default_options() {
  SegmentOptions options;
  options.threads = 1;
  options.denoise.threads = 1;
  return options;
}

std::optional<double> rand_error_of(std::span<const int> labels, const Shape& shape) {
  if (shape.truth.empty()) return std::nullopt;
  return bench::rand_error(bench::count_pairs(labels.first(shape.truth.size()), shape.truth));
}

std::vector<Described> describe_all(std::span<const Shape> shapes) {
  std::vector<Described> described(shapes.size());
  parallel_rows(shapes.size(), 0, [&](std::size_t i) { described[i] = describe(shapes[i]); });
  return described;
}

Shape make_shape(const solids::Member& member, const Sampling& sampling) {
  const std::uint64_t id = member.number * solids::family_names().size() + member.family;
  const std::uint64_t seed = bench::seed_of_model(sampling.seed, static_cast<int>(id));
  solids::LabelledPoints cloud = solids::sample_member(
      member, {.count = sampling.points, .noise = sampling.noise, .seed = seed});
  const auto outliers =
      static_cast<std::size_t>(sampling.outliers * static_cast<double>(sampling.points));
  for (const Vec3& p : bench::outliers_around(cloud.points, outliers, seed)) {
    cloud.points.push_back(p);
  }
  const std::string_view family = solids::family_names()[member.family];
  return {.name = fmt::format("{} {}", family, member.number + 1),
          .category = std::string(family),
          .points = bench::posed(std::move(cloud.points), seed),
          .truth = std::move(cloud.parts)};
}

std::vector<Shape> make_members(std::size_t members, const Sampling& sampling) {
  std::vector<Shape> shapes(solids::family_names().size() * members);
  parallel_rows(shapes.size(), 0, [&](std::size_t i) {
    shapes[i] = make_shape({.family = i / members, .number = i % members}, sampling);
  });
  return shapes;
}

const std::vector<Scoring>& scorings() {
  static const std::vector<Scoring> all{
      {"morsel", [](const Described& a,
                    const Described& b) { return match_score(a.signature, b.signature); }},
      {"paper's score, our parts",
       [](const Described& a, const Described& b) {
         return match_score(a.signature, b.signature, {.method = Method::kPaper});
       }},
      {"paper's score and parts",
       [](const Described& a, const Described& b) {
         return match_score(a.paper_signature, b.paper_signature, {.method = Method::kPaper});
       }},
      {"paper, to the letter", literal_score},
      {"D2", [](const Described& a, const Described& b) {
         return a.d2.size() == b.d2.size() ? -d2_distance(a.d2, b.d2) : -2.0;
       }}};
  return all;
}

std::vector<double> score_all(const Scoring& scoring, std::span<const Described> queries,
                              std::span<const Described> stored) {
  std::vector<double> scores(queries.size() * stored.size());
  parallel_rows(queries.size(), 0, [&](std::size_t row) {
    for (std::size_t i = 0; i < stored.size(); ++i) {
      scores[row * stored.size() + i] = scoring.score(queries[row], stored[i]);
    }
  });
  return scores;
}

nlohmann::ordered_json measures_json(const Scoring& scoring, std::span<const double> scores,
                                     std::span<const std::string> categories,
                                     std::span<const std::size_t> queries) {
  nlohmann::ordered_json json = {{"name", scoring.name}};
  bench::add_measures(bench::rank(scores, categories, queries), json);
  return json;
}

std::vector<std::size_t> all_of(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::vector<std::size_t> Collection::ranked(std::size_t scoring, std::size_t query) const {
  std::vector<std::size_t> order = all_of(size());
  order.erase(order.begin() + static_cast<std::ptrdiff_t>(query));
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](std::size_t i) { return score(scoring, query, i); });
  return order;
}

Collection make_collection(std::vector<Shape> shapes) {
  Collection collection;
  collection.described = describe_all(shapes);
  collection.shapes = std::move(shapes);
  for (const Shape& shape : collection.shapes) collection.categories.push_back(shape.category);
  for (const Scoring& scoring : scorings()) {
    collection.scores.push_back(score_all(scoring, collection.described, collection.described));
  }
  return collection;
}

}  // namespace morsel::reproduce
