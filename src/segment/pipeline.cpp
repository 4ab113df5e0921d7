// The stages in a row: plain values go in, plain values come out.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <morsel/morsel.hpp>
#include <utility>

#include "base/cancel.hpp"
#include "base/memory.hpp"
#include "base/spatial_order.hpp"
#include "denoise/denoise.hpp"
#include "denoise/thin.hpp"
#include "ground/ground.hpp"
#include "interior/bulge.hpp"

namespace morsel {
namespace {

// Times the stages and tells the caller about them.
class StageRunner {
 public:
  StageRunner(std::vector<StageCost>& costs, const Progress* progress)
      : costs_(costs), progress_(progress) {}

  // `fraction` of all work lies before this stage.
  template <typename Work>
  auto run(const char* stage, double fraction, const Work& work) {
    done_ = std::max(done_, fraction);  // stages may be run again
    if (progress_ != nullptr) progress_->report(stage, done_);
    const auto began = std::chrono::steady_clock::now();
    auto result = work();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - began;
    add({stage, taken.count(), peak_memory()});
    return result;
  }

 private:
  // A stage that is run again is still one.
  void add(const StageCost& cost) {
    const auto known = std::ranges::find(costs_, cost.stage, &StageCost::stage);
    if (known == costs_.end()) {
      costs_.push_back(cost);
    } else {
      known->seconds += cost.seconds;
      known->peak_bytes = cost.peak_bytes;
    }
  }

  std::vector<StageCost>& costs_;
  const Progress* progress_;
  double done_ = 0.0;
};

Denoised take_as_they_are(const SpatialOrder& order) {
  Denoised result;
  result.points = order.points;
  result.stand_in = order.order_of_point;
  return result;
}

// The points that are of objects and what closes those from below, without noise.
Denoised denoise_objects(const SpatialOrder& order, const Ground& ground,
                         const DenoiseOptions& options) {
  if (!ground.plane) return denoise(order, options);
  const std::vector<std::uint32_t>& place = order.order_of_point;
  std::vector<Vec3> objects;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (ground.apart[i] == 0) objects.push_back(order.points[place[i]]);
  }
  objects.insert(objects.end(), ground.base.begin(), ground.base.end());
  Denoised result = denoise(objects, options);
  std::vector<std::uint32_t> stand_in(place.size(), kNoStandIn);
  for (std::size_t i = 0, k = 0; i < place.size(); ++i) {
    if (ground.apart[i] == 0) stand_in[i] = result.stand_in[k++];
  }
  result.stand_in = std::move(stand_in);
  return result;
}

// λ of each vertex as of random points, by which the constants were tuned: those spread evenly have
// none very near, so that λ of as many is larger, and the gaps between them are smaller.
std::vector<double> find_lambda(const DelaunayComplex& complex, double kept_share, int threads) {
  constexpr double kEvenPower = 0.3;
  const double evenness = std::pow(kept_share, kEvenPower);
  std::vector<double> lambda = mean_neighbor_distance(complex, threads);
  for (double& value : lambda) value *= evenness;
  return lambda;
}

// Those of the points that stand in for others.
std::vector<std::uint32_t> vertices_of(const std::vector<std::uint32_t>& stand_in,
                                       const DelaunayComplex& complex) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(stand_in.size());
  for (const std::uint32_t i : stand_in) {
    vertices.push_back(i == kNoStandIn ? kNoVertex : complex.vertex_of_point[i]);
  }
  return vertices;
}

// Below this share of the inner cells' number an inside is no solid but chance holes in a cloud.
constexpr double kSmallestInside = 0.02;

bool has_inside(const DelaunayComplex& complex, const Interior& interior, const Basins& basins) {
  const auto cells = static_cast<double>(complex.cell_count());
  return basins.count() > 0 && static_cast<double>(interior.inner_cells) > kSmallestInside * cells;
}

// A sheet bounds no solid: more of its surface than this has no inside behind it, or more of what
// it bounds is open. Of a half sphere's inside a third is.
constexpr double kBareSheet = 1.0 / 3.0;
constexpr double kOpenSheet = 1.0 / 4.0;

bool is_sheet(const Interior& interior) {
  return interior.bare_share > kBareSheet || interior.open_share > kOpenSheet;
}

// More objects than this are rather the shreds of an open one.
constexpr std::size_t kManyObjects = 5;

Verdict judge(const Segmentation& s) {
  if (s.complex.vertices.size() < 4) return Verdict::kTooFewPoints;
  if (s.complex.dimension < 3) return Verdict::kFlat;
  const bool inside = has_inside(s.complex, s.interior, s.basins);
  return inside && !is_sheet(s.interior) ? Verdict::kSolid : Verdict::kNotSolid;
}

std::string describe_solid(const Segmentation& s) {
  const std::size_t parts = s.parts.parts.size();
  const std::size_t objects = s.tree.component_count;
  const std::vector<Opening>& openings = s.interior.openings;
  std::string text = std::to_string(parts) + (parts == 1 ? " part" : " parts");
  if (objects > 1) text += " in " + std::to_string(objects) + " separate objects";
  text += ".";
  if (!openings.empty()) {
    text += openings.size() == 1 ? " The surface was closed across an opening "
                                 : " The surface was closed across " +
                                       std::to_string(openings.size()) + " openings, the widest ";
    text += fmt::format("{:.3g} units wide.", 2.0 * openings.front().radius);
  }
  if (objects > kManyObjects) {
    text +=
        " If the cloud shows one object, its surface has gaps: scan the missing side or give "
        "more points.";
  }
  return text;
}

std::string describe_not_solid(const Segmentation& s) {
  if (s.interior.bare_share > kBareSheet) {
    return fmt::format(
        "{:.0f}% of the surface has no inside behind it: the points bound no solid. Scan the "
        "missing side, or give more points where walls are thin.",
        100.0 * s.interior.bare_share);
  }
  if (s.interior.open_share > kOpenSheet) {
    return fmt::format(
        "{:.0f}% of what the points enclose is open: they bound no solid. Scan the missing side.",
        100.0 * s.interior.open_share);
  }
  return "No inside was found: the points bound no solid. Close large holes, scan the missing "
         "side, "
         "or give more points where walls are thin.";
}

std::string describe_objects(const Segmentation& s) {
  switch (s.verdict) {
    case Verdict::kSolid:
      return describe_solid(s);
    case Verdict::kTooFewPoints:
      return "The cloud has " + std::to_string(s.complex.vertices.size()) +
             " distinct points; a solid needs at least four, a good sample thousands.";
    case Verdict::kFlat:
      return "All points lie on one plane or line; scan the object from all sides.";
    case Verdict::kNotSolid:
      return describe_not_solid(s);
  }
  return {};
}

std::string describe(const Segmentation& s) {
  std::string text = describe_objects(s);
  if (s.ground.plane) {
    text += fmt::format(" The ground was set apart, {} points.", s.ground.count_apart());
  }
  return text;
}

// More points than these, evenly spread, make no better parts; thin walls may need more, which
// shows in the surface that has no inside behind it.
constexpr std::size_t kEnoughPoints = 5500;
constexpr std::size_t kManyMore = 4;
constexpr double kLostSurface = 0.02;

// What the stages up to the basins make of the points.
struct Attempt {
  Denoised denoised;
  DelaunayComplex complex;
  VertexCells vertex_cells;
  std::vector<double> lambda;
  Interior interior;
  Basins basins;

  // Share of the surface whose inside was not found.
  [[nodiscard]] double lost() const {
    return has_inside(complex, interior, basins) ? interior.bare_share : 1.0;
  }
};

// What the points that are no vertices say of the surface above the inner cells.
void add_bulges(const Attempt& a, const std::vector<std::uint32_t>& vertex_of_sample,
                Interior& interior) {
  if (vertex_of_sample.empty()) return;
  interior.bulges = find_bulges(a.complex, interior.side, {a.denoised.samples, vertex_of_sample});
  for (const double bulge : interior.bulges) interior.volume += bulge;
}

Attempt attempt(const SpatialOrder& order, const Ground& ground, std::size_t most,
                const SegmentOptions& options, StageRunner& stages) {
  Attempt a;
  a.denoised = stages.run("denoise", 0.02, [&] {
    if (options.interior.method == Method::kPaper) return take_as_they_are(order);
    DenoiseOptions denoise_options = options.denoise;
    denoise_options.threads = options.threads;
    denoise_options.most_points = most;
    return denoise_objects(order, ground, denoise_options);
  });
  a.complex = stages.run("triangulate", 0.2,
                         [&] { return triangulate(a.denoised.points, {options.threads}); });
  a.lambda = stages.run("neighbors", 0.7, [&] {
    return find_lambda(a.complex, a.denoised.kept_share, options.threads);
  });
  const std::vector<std::uint32_t> vertex_of_sample =
      vertices_of(a.denoised.near_sample, a.complex);
  // From here on "point" means a point of the input, outliers and repeated ones included.
  a.complex.vertex_of_point = vertices_of(a.denoised.stand_in, a.complex);
  a.vertex_cells = find_vertex_cells(a.complex);
  a.interior = stages.run("interior", 0.75, [&] {
    Interior interior =
        find_interior(a.complex, a.vertex_cells, a.lambda, options.interior, options.threads);
    add_bulges(a, vertex_of_sample, interior);
    return interior;
  });
  a.basins = stages.run("basins", 0.85,
                        [&] { return find_basins(a.complex, a.interior, options.threads); });
  return a;
}

// With as few points as show all of the inside, or those that show most of it.
Attempt attempt_with_enough(const SpatialOrder& order, const Ground& ground,
                            const SegmentOptions& options, StageRunner& stages) {
  const bool all = options.interior.method == Method::kPaper || options.denoise.rounds == 0;
  const std::size_t limit = options.denoise.most_points;
  std::size_t most = all ? limit : std::min(kEnoughPoints, limit);
  Attempt best = attempt(order, ground, most, options, stages);
  if (best.lost() <= kLostSurface || most >= std::min(limit, order.points.size())) return best;
  const std::size_t useful = std::min(limit, useful_points(order.points, options.threads));
  while (best.lost() > kLostSurface && most < useful) {
    most = std::min(kManyMore * most, useful);
    Attempt next = attempt(order, ground, most, options, stages);
    if (next.lost() < best.lost()) best = std::move(next);
  }
  return best;
}

}  // namespace

std::string version() { return MORSEL_VERSION; }

void SegmentOptions::check() const {
  interior.check();
  denoise.check();
  cut.check();
}

Segmentation segment(std::span<const Vec3> points, const SegmentOptions& options,
                     const Progress* progress) {
  options.check();
  const CancelScope scope(progress);
  const bool paper = options.interior.method == Method::kPaper;
  Segmentation s;
  StageRunner stages(s.costs, progress);
  const SpatialOrder order =
      stages.run("sort", 0.0, [&] { return sort_spatially(points, options.threads); });
  s.ground = stages.run("ground", 0.01, [&] {
    return paper ? Ground{} : find_ground(order, {options.ground.mode, options.threads});
  });
  Attempt found = attempt_with_enough(order, s.ground, options, stages);
  s.denoised = std::move(found.denoised);
  s.complex = std::move(found.complex);
  s.interior = std::move(found.interior);
  s.basins = std::move(found.basins);
  s.verdict = judge(s);
  if (s.verdict == Verdict::kSolid) {
    s.tree = stages.run("merge", 0.9, [&] {
      return build_merge_tree(s.complex, found.vertex_cells, found.lambda, s.interior, s.basins,
                              options.interior.method, options.threads);
    });
    s.parts = stages.run("cut", 0.97, [&] { return cut(s.tree, options.cut); });
    s.labels = s.parts.part_of_point;
  } else {
    s.labels.assign(points.size(), -1);
  }
  s.message = describe(s);
  if (progress != nullptr) progress->report("done", 1.0);
  return s;
}

Segmentation recut(Segmentation segmentation, const CutOptions& cut) {
  cut.check();
  Segmentation& s = segmentation;
  if (s.verdict != Verdict::kSolid) return segmentation;
  s.parts = morsel::cut(s.tree, cut);
  s.labels = s.parts.part_of_point;
  s.message = describe(s);
  return segmentation;
}

}  // namespace morsel
