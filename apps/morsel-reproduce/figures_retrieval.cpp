// Figures 5, 6 and 7: query rows, the similarity matrix, and where D2 and the parts disagree.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "balls.hpp"
#include "base/threads.hpp"
#include "collection.hpp"
#include "describe.hpp"
#include "sampling.hpp"
#include "sections.hpp"

namespace morsel::reproduce {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kBest = 5;

ordered_json matrix_of(const Collection& c) {
  ordered_json json;
  json["categories"] = c.categories;
  const std::vector<std::size_t> all = all_of(c.size());
  for (std::size_t k = 0; k < scorings().size(); ++k) {
    ordered_json row = measures_json(scorings()[k], c.scores[k], c.categories, all);
    for (std::size_t query = 0; query < c.size(); ++query) {
      std::vector<std::size_t> best = c.ranked(k, query);
      best.resize(std::min(best.size(), kBest));
      row["best"].push_back(best);
    }
    json["scorings"].push_back(std::move(row));
  }
  return json;
}

Image picture_of(std::span<const Vec3> points, std::span<const int> labels,
                 std::span<const Vec3> pose) {
  return render_parts(points, labels, {.width = 220, .views = 1, .pose_of = pose});
}

// The source turned onto the target, corresponding parts in one colour.
Image turned_picture(const Collection& c, const Match& match, std::size_t target,
                     std::size_t source) {
  return picture_of(on_target(match, c.shapes[source].points),
                    parts_on_target(match, c.described[source].labels), c.shapes[target].points);
}

ordered_json hit_json(const Study& study, const std::string& file, const Collection& c,
                      std::size_t query, std::size_t hit) {
  const Match match = morsel::match(c.described[query].signature, c.described[hit].signature);
  return {{"name", c.shapes[hit].name},
          {"category", c.categories[hit]},
          {"score", match.score},
          {"same", c.categories[hit] == c.categories[query]},
          {"mirrored", match.mirrored},
          {"picture", study.keep(file, turned_picture(c, match, query, hit))}};
}

// A query of every other class or so.
ordered_json query_rows(const Study& study, const std::string& name, const Collection& c) {
  std::vector<std::size_t> queries;
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (i == 0 || c.categories[i] != c.categories[i - 1]) queries.push_back(i);
  }
  ordered_json rows = ordered_json::array();
  const std::size_t step = study.amount(2, queries.size());
  for (std::size_t i = 0; i < queries.size(); i += step) {
    const std::size_t query = queries[i];
    const Shape& shape = c.shapes[query];
    const std::string file = fmt::format("query-{}-{}", name, rows.size());
    ordered_json row = {
        {"name", shape.name},
        {"category", shape.category},
        {"picture", study.keep(file, picture_of(shape.points, c.described[query].labels, {}))}};
    const std::vector<std::size_t> ranked = c.ranked(kDefaultScore, query);
    for (std::size_t k = 0; k < std::min(kBest, ranked.size()); ++k) {
      row["hits"].push_back(hit_json(study, fmt::format("{}-{}", file, k), c, query, ranked[k]));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

// A query, a shape of its class and one of another.
struct Triple {
  std::size_t query = 0;
  std::size_t same = 0;
  std::size_t other = 0;
};

// How often each of two scorings ranks the shape of another class nearer.
struct Disagreement {
  std::size_t both_right = 0;
  std::size_t only_d2_wrong = 0;
  std::size_t only_parts_wrong = 0;
  std::size_t both_wrong = 0;
  std::optional<Triple> clearest;  // of those that only D2 has wrong
};

void count_query(const Collection& c, std::size_t scoring, std::size_t query, Disagreement& d,
                 double& clearest) {
  for (std::size_t same = 0; same < c.size(); ++same) {
    if (same == query || c.categories[same] != c.categories[query]) continue;
    for (std::size_t other = 0; other < c.size(); ++other) {
      if (c.categories[other] == c.categories[query]) continue;
      const double d2 = c.score(kD2, query, same) - c.score(kD2, query, other);
      const double parts = c.score(scoring, query, same) - c.score(scoring, query, other);
      if (d2 > 0.0) {
        ++(parts > 0.0 ? d.both_right : d.only_parts_wrong);
        continue;
      }
      ++(parts > 0.0 ? d.only_d2_wrong : d.both_wrong);
      if (std::min(-d2, parts) <= clearest) continue;
      clearest = std::min(-d2, parts);
      d.clearest = Triple{query, same, other};
    }
  }
}

Disagreement disagreement(const Collection& c, std::size_t scoring) {
  Disagreement d;
  double clearest = 0.0;
  for (std::size_t query = 0; query < c.size(); ++query) {
    count_query(c, scoring, query, d, clearest);
  }
  return d;
}

ordered_json counts_json(const std::string& name, const Disagreement& d) {
  return {{"name", name},
          {"both_right", d.both_right},
          {"only_d2_wrong", d.only_d2_wrong},
          {"only_parts_wrong", d.only_parts_wrong},
          {"both_wrong", d.both_wrong}};
}

ordered_json member_json(const Study& study, const std::string& file, const Collection& c,
                         std::size_t query, std::size_t i, std::size_t scoring) {
  const Described& q = c.described[query];
  const Described& s = c.described[i];
  const Match match = morsel::match(q.signature, s.signature);
  std::vector<Ball> balls = balls_of(q.parts);
  if (i != query) {
    const std::vector<Ball> laid = balls_on_target(match, s.parts);
    balls.insert(balls.end(), laid.begin(), laid.end());
  }
  return {{"name", c.shapes[i].name},
          {"category", c.categories[i]},
          {"d2", s.d2},
          {"d2_distance", -c.score(kD2, query, i)},
          {"score", c.score(scoring, query, i)},
          {"picture", study.keep(file, turned_picture(c, match, query, i))},
          {"balls", study.keep(file + "-balls", draw_balls(c.shapes[query].points, balls))}};
}

ordered_json d2_figure(const Study& study, const std::string& name, const Collection& c) {
  ordered_json json;
  for (const std::size_t scoring : {kDefaultScore, kPaperOurParts, kPaperScore}) {
    const Disagreement d = disagreement(c, scoring);
    json["counts"].push_back(counts_json(scorings()[scoring].name, d));
    if (scoring != kDefaultScore || !d.clearest) continue;
    const auto& [query, same, other] = *d.clearest;
    json["case"] = {
        {"query", member_json(study, "d2-" + name + "-query", c, query, query, scoring)},
        {"same", member_json(study, "d2-" + name + "-same", c, query, same, scoring)},
        {"other", member_json(study, "d2-" + name + "-other", c, query, other, scoring)}};
  }
  return json;
}

}  // namespace

Collection make_generated(const Study& study) {
  return make_collection(make_members(study.amount(12, 2), {.points = study.shape_points()}));
}

Collection make_psb(const Study& study) {
  const std::filesystem::path& folder = study.options.psb;
  std::map<std::string, std::vector<bench::ClassedShape>> classes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".cla") continue;
    for (const auto& shape : bench::read_classification(entry.path(), folder)) {
      classes[shape.category].push_back(shape);
    }
  }
  // The largest classes, as many as the paper's, and of each as many shapes.
  std::vector<std::vector<bench::ClassedShape>> largest;
  for (auto& [name, members] : classes) largest.push_back(std::move(members));
  std::ranges::stable_sort(largest, std::ranges::greater{}, [](const auto& c) { return c.size(); });
  largest.resize(std::min(largest.size(), solids::family_names().size()));
  const std::size_t members = study.amount(12, 2);
  std::vector<bench::ClassedShape> files;
  for (auto& c : largest) {
    c.resize(std::min(c.size(), members));
    files.insert(files.end(), c.begin(), c.end());
  }
  if (files.empty()) {
    throw Error(
        ErrorCode::kInput,
        fmt::format("{}: no classification; expected a .cla file in the folder", folder.string()));
  }
  std::vector<Shape> shapes(files.size());
  parallel_rows(files.size(), 0, [&](std::size_t i) {
    const bench::Cloud cloud =
        bench::sample_cloud(read_mesh(files[i].path), static_cast<int>(i),
                            {.points = study.shape_points(), .noise = 0.002});
    shapes[i] = {
        .name = files[i].name, .category = files[i].category, .points = cloud.points, .truth = {}};
  });
  return make_collection(std::move(shapes));
}

void add_retrieval(Study& study, const std::string& name, const Collection& collection) {
  say("  query rows");
  ordered_json& json = study.figures["retrieval"][name];
  json["queries"] = query_rows(study, name, collection);
  json["matrix"] = matrix_of(collection);
  say("  D2 against the parts");
  json["d2"] = d2_figure(study, name, collection);
}

}  // namespace morsel::reproduce
