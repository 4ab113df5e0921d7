// Figures 3 and 4: parts in colours under noise, and their representative points as balls.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "balls.hpp"
#include "base/box.hpp"
#include "base/noise.hpp"
#include "base/random.hpp"
#include "describe.hpp"
#include "sections.hpp"
#include "stopwatch.hpp"
#include "summary.hpp"

namespace morsel::reproduce {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kPoints = 20000;
constexpr std::array<double, 3> kNoise{0.0, 0.003, 0.005};

// Of Debian's libcgal-demo.
struct DemoShape {
  const char* name;
  const char* file;
};
constexpr std::array<DemoShape, 18> kDemoShapes{{{"bull", "meshes/bull.off"},
                                                 {"triceratops", "meshes/triceratops.off"},
                                                 {"pig", "meshes/pig.off"},
                                                 {"dinosaur", "meshes/dino.off"},
                                                 {"camel", "meshes/camel.off"},
                                                 {"human", "meshes/man.off"},
                                                 {"hand", "meshes/hand.off"},
                                                 {"cow", "meshes/cow.off"},
                                                 {"elephant", "meshes/elephant.off"},
                                                 {"cactus", "meshes/cactus.off"},
                                                 {"anchor (CAD)", "meshes/anchor_dense.off"},
                                                 {"joint (CAD)", "meshes/joint.off"},
                                                 {"rotor (CAD)", "meshes/rotor.off"},
                                                 {"coupling (CAD)", "meshes/couplingdown.off"},
                                                 {"bunny", "meshes/bunny00.off"},
                                                 {"femur", "meshes/femur.off"},
                                                 {"diplodocus", "meshes/diplodocus.off"},
                                                 {"kitten (points)", "points_3/kitten.xyz"}}};

// What is cut: a mesh to be sampled, or points to which noise is added.
struct Source {
  std::string name;
  std::string origin;
  std::filesystem::path file;  // empty: generated
  solids::Member member;
};

std::vector<Source> sources_of(const Study& study) {
  std::vector<Source> sources;
  for (const DemoShape& shape : kDemoShapes) {
    const std::filesystem::path file = study.options.data / shape.file;
    if (study.options.data.empty() || !exists(file)) continue;
    sources.push_back({shape.name, file.filename().string(), file, {}});
  }
  for (const auto& scan : study.options.scans) {
    sources.push_back({scan.stem().string(), scan.filename().string() + ", a scan", scan, {}});
  }
  for (std::size_t family = 0; sources.empty() && family < 2; ++family) {
    sources.push_back({std::string(solids::family_names()[family]), "generated", {}, {family}});
  }
  return sources;
}

// As sampling a mesh does it: Gaussian, a fraction of the diagonal.
std::vector<Vec3> noisy(std::vector<Vec3> points, double noise) {
  Random random(1);
  add_noise(points, noise * bounding_box(points).diagonal(), random);
  return points;
}

// For the name of a file.
std::string file_name(const std::string& name) {
  std::string slug;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) slug += c;
  }
  return slug;
}

std::vector<Vec3> points_of(const Study& study, const Source& source, double noise) {
  const std::size_t count = study.amount(kPoints, 2000);
  if (source.file.empty()) {
    return sample_member(source.member, {.count = count, .noise = noise}).points;
  }
  if (is_mesh_file(source.file)) {
    return read_points(source.file, {.count = count, .noise = noise}).points;
  }
  return noisy(read_points(source.file).points, noise);
}

ordered_json run_json(const Segmentation& s, double noise, double seconds) {
  return {{"noise", noise},
          {"verdict", bench::verdict_name(s.verdict)},
          {"parts", s.parts.parts.size()},
          {"volume", s.interior.volume},
          {"seconds", seconds}};
}

struct Way {
  const char* name;
  SegmentOptions options;
};

// One shape's points, at one level of noise, by one method.
ordered_json cut_once(const Study& study, const Source& source, const Way& way, double noise,
                      std::span<const Vec3> points, std::span<const Vec3> pose) {
  SegmentOptions options = way.options;
  options.threads = options.denoise.threads = 0;
  const bench::Stopwatch watch;
  const Segmentation s = segment(points, options);
  ordered_json json = run_json(s, noise, watch.seconds());
  json["method"] = way.name;
  json["points"] = points.size();
  const std::string slug = file_name(source.name);
  json["picture"] =
      study.keep(fmt::format("parts-{}-{}-{:g}", slug, way.name, 1000.0 * noise),
                 render_parts(points, s.labels, {.width = 300, .views = 1, .pose_of = pose}));
  if (noise == 0.0 && options.interior.method == Method::kDefault) {
    json["balls"] = study.keep("balls-" + slug, draw_balls(points, balls_of(s.parts)));
  }
  return json;
}

}  // namespace

void add_parts(Study& study) {
  const std::array<Way, 2> ways{{{"paper", paper_options()}, {"default", default_options()}}};
  ordered_json shapes = ordered_json::array();
  std::vector<Source> sources = sources_of(study);
  sources.resize(std::min(sources.size(), study.amount(sources.size(), 2)));
  for (const Source& source : sources) {
    say("  " + source.name);
    const std::vector<Vec3> pose = points_of(study, source, 0.0);
    ordered_json shape = {{"name", source.name}, {"source", source.origin}};
    for (const double noise : kNoise) {
      const std::vector<Vec3> points = points_of(study, source, noise);
      for (const Way& way : ways) {
        shape["runs"].push_back(cut_once(study, source, way, noise, points, pose));
      }
    }
    shapes.push_back(std::move(shape));
  }
  study.figures["parts"] = {{"shapes", std::move(shapes)}};
}

}  // namespace morsel::reproduce
