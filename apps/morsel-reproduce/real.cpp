// Rand error on meshes that people have cut: the Princeton Segmentation Benchmark.
#include <fmt/format.h>

#include <map>

#include "base/threads.hpp"
#include "dataset.hpp"
#include "describe.hpp"
#include "measures.hpp"
#include "sampling.hpp"
#include "sections.hpp"
#include "summary.hpp"

namespace morsel::reproduce {
namespace {

using nlohmann::ordered_json;

// A mesh and what people make of it.
struct Annotated {
  int id = 0;
  TriangleMesh mesh;
  std::vector<std::vector<int>> people;
};

// The first few of each category.
std::vector<Annotated> read_annotated(const std::filesystem::path& folder, std::size_t most) {
  std::map<int, std::size_t> taken;
  std::vector<Annotated> all;
  for (const bench::Model& model : bench::list_models(folder, {})) {
    if (model.people.empty() || taken[bench::category_of(model.id)]++ >= most) continue;
    Annotated one{.id = model.id, .mesh = read_mesh(model.mesh), .people = {}};
    for (const auto& file : model.people) {
      one.people.push_back(bench::read_face_labels(file, one.mesh.triangles.size()));
    }
    all.push_back(std::move(one));
  }
  return all;
}

double error_of(const Annotated& one, const bench::Cloud& cloud, const SegmentOptions& options) {
  const Segmentation s = segment(cloud.points, options);
  const std::vector<int> labels = bench::face_labels(one.mesh, cloud, s.labels);
  double sum = 0.0;
  for (const auto& person : one.people) {
    sum += bench::rand_error(bench::count_pairs(labels, person));
  }
  return sum / static_cast<double>(one.people.size());
}

ordered_json level_json(const std::vector<Annotated>& all, double noise, double outliers,
                        std::size_t points) {
  std::vector<double> ours(all.size());
  std::vector<double> rules(all.size());
  parallel_rows(all.size(), 0, [&](std::size_t i) {
    const bench::Cloud cloud = bench::sample_cloud(
        all[i].mesh, all[i].id, {.points = points, .noise = noise, .outliers = outliers});
    ours[i] = error_of(all[i], cloud, default_options());
    rules[i] = error_of(all[i], cloud, paper_options());
  });
  say(fmt::format("  noise {:g}, outliers {:g}: {:.3f}", noise, outliers, bench::mean(ours)));
  return {{"noise", noise},
          {"outliers", outliers},
          {"default", bench::mean(ours)},
          {"paper", bench::mean(rules)}};
}

}  // namespace

void add_annotated(Study& study) {
  const auto all = read_annotated(study.options.segmentation, study.amount(2, 1));
  const std::size_t points = study.amount(10000, 2000);
  ordered_json json = {{"models", all.size()}, {"points", points}};
  for (const double noise : {0.0, 0.003, 0.005, 0.01, 0.02}) {
    json["noise"].push_back(level_json(all, noise, 0.0, points));
  }
  for (const double outliers : {0.0, 0.01, 0.03, 0.1}) {
    json["outliers"].push_back(level_json(all, 0.0, outliers, points));
  }
  study.figures["annotated"] = std::move(json);
}

}  // namespace morsel::reproduce
