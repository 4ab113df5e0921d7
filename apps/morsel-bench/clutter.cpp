// morsel-bench clutter: objects on a plane and beside each other.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "base/box.hpp"
#include "base/noise.hpp"
#include "base/point_tree.hpp"
#include "base/random.hpp"
#include "commands.hpp"
#include "levels.hpp"
#include "measures.hpp"
#include "sampling.hpp"
#include "summary.hpp"

namespace morsel::bench {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct Options {
  RunOptions run;
  double plane = 0.0;    // side over the longer one of what stands on it; 0: none
  double density = 1.0;  // of the plane's points over the object's
  bool scanned = false;  // nothing is seen of the plane and of objects beneath them
  bool pairs = false;
};

// What is segmented: the samples of one model, of its mate, and the plane's.
struct Scene {
  Cloud cloud;             // its triangles are of the model alone
  std::vector<Vec3> home;  // where the model's samples lie on its mesh
  std::size_t mate = 0;    // samples of it, after the model's
  double volume = 0.0;     // of both
};

double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3& origin = mesh.vertices[a];
    area += 0.5 * norm(cross(mesh.vertices[b] - origin, mesh.vertices[c] - origin));
  }
  return area;
}

double along(const Vec3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

// Turned so that z is up and the side of its box down that most samples touch.
struct Stand {
  int axis = 2;
  double sign = 1.0;

  [[nodiscard]] Vec3 apply(const Vec3& p) const {
    return {sign * along(p, (axis + 1) % 3), along(p, (axis + 2) % 3), sign * along(p, axis)};
  }
};

Stand stand_of(std::span<const Vec3> points) {
  constexpr double kTouches = 0.01;  // of the diagonal
  const double reach = kTouches * bounding_box(points).diagonal();
  Stand best;
  std::ptrdiff_t most = -1;
  for (const int axis : {0, 1, 2}) {
    for (const double sign : {1.0, -1.0}) {
      const auto height = [&](const Vec3& p) { return sign * along(p, axis); };
      const double low = height(*std::ranges::min_element(points, {}, height));
      const auto touching =
          std::ranges::count_if(points, [&](const Vec3& p) { return height(p) <= low + reach; });
      if (touching <= most) continue;
      most = touching;
      best = {axis, sign};
    }
  }
  return best;
}

// Stands on z = 0 with its middle at (x, 0); of diagonal 1.
struct Placed {
  Cloud cloud;
  std::vector<Vec3> home;  // before it was placed
  double volume = 0.0;
  double density = 0.0;  // samples a unit of area
};

Placed place(const TriangleMesh& mesh, int id, const CloudOptions& options) {
  Placed placed;
  placed.cloud = sample_cloud(mesh, id, options);
  placed.home = placed.cloud.points;
  const Stand stand = stand_of(placed.home);
  const double scale = 1.0 / bounding_box(mesh.vertices).diagonal();
  for (Vec3& p : placed.cloud.points) p = scale * stand.apply(p);
  const Box box = bounding_box(placed.cloud.points);
  const Vec3 middle = 0.5 * (box.low + box.high);
  for (Vec3& p : placed.cloud.points) p = p - Vec3{middle.x, middle.y, box.low.z};
  placed.volume = std::abs(signed_volume(mesh)) * scale * scale * scale;
  placed.density =
      static_cast<double>(placed.cloud.sample_count()) / (area_of(mesh) * scale * scale);
  return placed;
}

// The scanner stands above: it sees no base, and no plane beneath the objects.
void drop_unseen(Scene& scene, std::vector<Vec3>& plane) {
  constexpr double kBase = 0.002;   // height of what is taken for base, diagonals
  constexpr double kShadow = 0.02;  // of samples on the plane
  const Cloud cloud = std::move(scene.cloud);
  const std::vector<Vec3> home = std::move(scene.home);
  std::vector<Vec3> shadow;
  for (const Vec3& p : cloud.points) shadow.push_back({p.x, p.y, 0.0});
  const PointTree tree(shadow);
  std::erase_if(plane, [&](const Vec3& p) { return tree.nearest(p).distance < kShadow; });
  scene.cloud = {};
  scene.home.clear();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.points[i].z < kBase) continue;
    scene.cloud.points.push_back(cloud.points[i]);
    if (i >= cloud.sample_count()) continue;
    scene.cloud.triangle.push_back(cloud.triangle[i]);
    scene.home.push_back(home[i]);
  }
}

std::vector<Vec3> sample_plane(const Box& box, const Options& options, double density,
                               Random& random) {
  const double longer = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  const double side = options.plane * longer;
  const Vec3 middle = 0.5 * (box.low + box.high);
  const auto count = static_cast<std::size_t>(density * options.density * side * side);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = middle.x + side * (random.uniform() - 0.5);
    points.push_back({x, middle.y + side * (random.uniform() - 0.5), 0.0});
  }
  return points;
}

Scene make_scene(const Model& model, const Model* mate, const Options& options, double noise) {
  constexpr double kGap = 0.1;  // diagonals between the boxes of a pair
  const CloudOptions clean = options.run.cloud(0.0);
  Placed placed = place(read_mesh(model.mesh), model.id, clean);
  Scene scene;
  scene.cloud = std::move(placed.cloud);
  scene.home = std::move(placed.home);
  scene.volume = placed.volume;
  if (mate != nullptr) {
    const Placed other = place(read_mesh(mate->mesh), mate->id, clean);
    const Box here = bounding_box(scene.cloud.points);
    const Box there = bounding_box(other.cloud.points);
    const Vec3 step{here.high.x - there.low.x + kGap, 0.0, 0.0};
    for (const Vec3& p : other.cloud.points) scene.cloud.points.push_back(p + step);
    scene.volume += other.volume;
  }
  Random random(seed_of_model(options.run.seed, model.id));
  std::vector<Vec3> plane;
  if (options.plane > 0.0) {
    plane = sample_plane(bounding_box(scene.cloud.points), options, placed.density, random);
    if (options.scanned) drop_unseen(scene, plane);
  }
  scene.mate = scene.cloud.points.size() - scene.cloud.sample_count();
  scene.cloud.points.insert(scene.cloud.points.end(), plane.begin(), plane.end());
  add_noise(scene.cloud.points, noise, random);
  return scene;
}

// Whether a part has samples of both models.
bool is_mixed(const Scene& scene, const std::vector<int>& labels) {
  const auto middle = labels.begin() + static_cast<std::ptrdiff_t>(scene.cloud.sample_count());
  std::set<int> own(labels.begin(), middle);
  own.erase(-1);
  return std::any_of(middle, middle + static_cast<std::ptrdiff_t>(scene.mate),
                     [&](int label) { return own.contains(label); });
}

json evaluate(const Model& model, const Model* mate, const Options& options, double noise) {
  const Scene scene = make_scene(model, mate, options, noise);
  const Segmentation s = segment(scene.cloud.points, options.run.segment());
  const std::vector<int>& labels = s.labels;
  const std::size_t objects = scene.cloud.sample_count() + scene.mate;
  const auto apart = [&](std::size_t begin, std::size_t end) {
    const auto at = [&](std::size_t i) { return labels.begin() + static_cast<std::ptrdiff_t>(i); };
    return begin == end ? 0.0
                        : static_cast<double>(std::count(at(begin), at(end), -1)) /
                              static_cast<double>(end - begin);
  };
  const TriangleMesh mesh = read_mesh(model.mesh);
  const Cloud at_home{.points = scene.home, .triangle = scene.cloud.triangle};
  const Scores scores = compare_with_people(mesh, face_labels(mesh, at_home, labels),
                                            read_people(model, mesh.triangles.size()));
  double ground_seconds = 0.0;
  double triangulate_seconds = 0.0;
  for (const StageCost& cost : s.costs) {
    if (cost.stage == "ground") ground_seconds = cost.seconds;
    if (cost.stage == "triangulate") triangulate_seconds = cost.seconds;
  }
  return {{"verdict", verdict_name(s.verdict)},
          {"ground", s.ground.plane.has_value()},
          {"ratio", scene.volume > 0.0 ? s.interior.volume / scene.volume : 0.0},
          {"rand", scores[kRand].value_or(1.0)},
          {"objects", s.tree.component_count},
          {"parts", s.parts.parts.size()},
          {"mixed", is_mixed(scene, labels)},
          {"lost", apart(0, objects)},
          {"plane_apart", apart(objects, labels.size())},
          {"ground_seconds", ground_seconds},
          {"triangulate_seconds", triangulate_seconds}};
}

ordered_json report_level(const std::vector<Model>& models, const std::vector<Outcome>& outcomes,
                          double noise, bool pairs) {
  ordered_json run = {{"noise", noise}, {"models_total", models.size()}};
  std::vector<double> errors;
  std::array<std::vector<double>, 5> values;
  constexpr std::array<const char*, 5> kMeans = {"rand", "lost", "plane_apart", "ground_seconds",
                                                 "triangulate_seconds"};
  std::size_t within = 0;
  std::size_t ground = 0;
  std::size_t counted = 0;
  std::size_t mixed = 0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    ordered_json model = {{"id", models[i].id}};
    const json& value = outcomes[i].value;
    if (!outcomes[i].error.empty()) {
      model["error"] = outcomes[i].error;
      fmt::print("{}: {}\n", models[i].id, outcomes[i].error);
      errors.push_back(1.0);
    } else {
      model.update(value);
      errors.push_back(std::abs(value.at("ratio").get<double>() - 1.0));
      ground += value.at("ground").get<bool>() ? 1 : 0;
      counted += value.at("objects").get<std::size_t>() == (pairs ? 2 : 1) ? 1 : 0;
      mixed += value.at("mixed").get<bool>() ? 1 : 0;
      for (std::size_t m = 0; m < kMeans.size(); ++m) {
        values[m].push_back(value.at(kMeans[m]).get<double>());
      }
    }
    within += errors.back() <= 0.1 ? 1 : 0;
    run["models"].push_back(model);
  }
  run["ground_found"] = ground;
  run["within_10_percent"] = within;
  run["median_error"] = median(errors);
  run["right_number_of_objects"] = counted;
  run["with_a_part_of_both"] = mixed;
  for (std::size_t m = 0; m < kMeans.size(); ++m) run[kMeans[m]] = mean(values[m]);
  fmt::print(
      "noise {:g}: of {} models ground found in {}, inner volume within 10% in {} (median error "
      "{:.2f}%), right number of objects in {}, a part of both in {}; Rand error {:.4f}; of the "
      "object's points {:.2f}% lost to the ground, of the plane's {:.2f}% apart; ground stage "
      "{:.3f} of triangulation\n",
      noise, models.size(), ground, within, 100.0 * median(errors), counted, mixed, mean(values[0]),
      100.0 * mean(values[1]), 100.0 * mean(values[2]), mean(values[3]) / mean(values[4]));
  return run;
}

void run(const Options& options) {
  const std::vector<Model> all = options.run.models();
  const auto mate_of = [&](const Model& model) -> const Model* {
    if (!options.pairs) return nullptr;
    const auto at = std::ranges::find(all, model.id, &Model::id) - all.begin();
    return &all[(static_cast<std::size_t>(at) + all.size() / 2) % all.size()];
  };
  ordered_json head = report_head("clutter", options.run);
  head["options"].update({{"plane", options.plane},
                          {"density", options.density},
                          {"scanned", options.scanned},
                          {"pairs", options.pairs}});
  run_levels(
      options.run, head,
      [&](const Model& model, double noise) {
        return evaluate(model, mate_of(model), options, noise);
      },
      [&](const auto& models, const auto& outcomes, double noise) {
        return report_level(models, outcomes, noise, options.pairs);
      });
}

}  // namespace

void add_clutter(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "clutter", "Sets meshes onto a plane and beside each other: ground, objects, inner volume");
  add_run_options(*command, options->run);
  command
      ->add_option("--plane", options->plane,
                   "Side of a plane under the object over the object's longer one; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 100.0));
  command->add_option("--density", options->density, "Of the plane's samples over the object's")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 100.0));
  command->add_flag("--scanned", options->scanned,
                    "Leave out the object's base and the plane beneath it");
  command->add_flag("--pairs", options->pairs, "Put another model beside each");
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
