// morsel-bench partial: do pieces find the shape that they are of, and their place on it?
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <morsel/morsel.hpp>
#include <morsel/partial.hpp>
#include <morsel/sketch.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/base64.hpp"
#include "base/point_tree.hpp"
#include "base/random.hpp"
#include "collection.hpp"
#include "commands.hpp"
#include "isolated.hpp"
#include "pose.hpp"
#include "run_options.hpp"
#include "sampling.hpp"
#include "stopwatch.hpp"
#include "summary.hpp"

namespace morsel::bench {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::array<double, 4> kKept{1.0, 0.7, 0.5,
                                      0.3};  // shares of the samples; the first: whole
constexpr std::size_t kTop = 5;

// The samples on one side of a random plane: `kept` of all.
std::vector<Vec3> cut_off(const std::vector<Vec3>& points, double kept, std::uint64_t seed) {
  Random random(seed);
  const double x = random.normal();
  const double y = random.normal();
  const Vec3 direction{x, y, random.normal()};
  std::vector<double> heights;
  for (const Vec3& p : points) heights.push_back(dot(direction, p));
  std::vector<double> sorted = heights;
  const auto count = static_cast<std::size_t>(kept * static_cast<double>(points.size()));
  if (count >= points.size()) return points;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count),
                   sorted.end());
  std::vector<Vec3> rest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (heights[i] < sorted[count]) rest.push_back(points[i]);
  }
  return rest;
}

std::uint64_t seed_of(const RunOptions& options, std::size_t shape, std::size_t kept) {
  return seed_of_model(options.seed, static_cast<int>(shape * kKept.size() + kept));
}

Eigen::Affine3d pose_of(std::uint64_t seed) {
  const std::vector<Vec3> frame = posed({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, seed);
  Eigen::Affine3d pose = Eigen::Affine3d::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 along = frame[static_cast<std::size_t>(axis) + 1] - frame[0];
    pose.linear().col(axis) = Eigen::Vector3d(along.x, along.y, along.z);
  }
  pose.translation() = Eigen::Vector3d(frame[0].x, frame[0].y, frame[0].z);
  return pose;
}

// A whole shape or a piece as a database would hold it, and how it came to stand as it does.
struct Thing {
  Sketch sketch;
  Signature signature;
  Eigen::Affine3d pose;
};

json describe(const ClassedShape& shape, std::size_t index, std::size_t kept, double noise,
              const RunOptions& options) {
  const Cloud cloud =
      sample_cloud(read_mesh(shape.path), static_cast<int>(index), options.cloud(noise));
  const std::uint64_t seed = seed_of(options, index, kept);
  const Segmentation s =
      segment(posed(cut_off(cloud.points, kKept[kept], seed), seed), options.segment());
  return {{"sketch", encode_base64(encode_sketch(make_sketch(s)))},
          {"signature", to_json(make_signature(s, 1))}};
}

Thing thing_of(const Outcome& outcome, std::uint64_t seed) {
  Thing thing;
  thing.pose = pose_of(seed);
  if (!outcome.error.empty()) return thing;
  const auto bytes = decode_base64(outcome.value.at("sketch").get<std::string>());
  thing.sketch = decode_sketch(bytes.value(), "sketch");
  thing.signature = signature_from_json(outcome.value.at("signature").get<std::string>());
  return thing;
}

// Into the unit of the mesh: the pose's scale taken out again.
void scale_back(Thing& thing) {
  const double scale = 1.0 / std::cbrt(std::abs(thing.pose.linear().determinant()));
  for (Vec3& p : thing.sketch.points) p = scale * p;
  thing.signature.size *= scale;
  thing.pose = Eigen::Scaling(scale) * thing.pose;
}

Surface surface_of(const Thing& thing) { return {thing.sketch.points, thing.sketch.parts}; }

double root_mean(double squares, std::size_t count, double unit) {
  return std::sqrt(squares / static_cast<double>(count)) / unit;
}

// How far the piece's points come to lie from where they belong on the whole, RMS, in sizes of the
// whole. A shape with symmetries has other places that are as good.
double off_place(const Match& found, const Thing& whole, const Thing& piece) {
  const Eigen::Affine3d truth = whole.pose * piece.pose.inverse();
  const std::vector<Vec3> placed = on_target(found, piece.sketch.points);
  double squares = 0.0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Vec3& p = piece.sketch.points[i];
    const Eigen::Vector3d at = truth * Eigen::Vector3d(p.x, p.y, p.z);
    squares += squared_distance(placed[i], {at.x(), at.y(), at.z()});
  }
  return root_mean(squares, placed.size(), whole.signature.size);
}

// How far they come to lie from the nearest points of the whole, likewise: some .04 for exact ones.
double off_surface(const Match& found, const Thing& whole, const Thing& piece) {
  const PointTree tree(whole.sketch.points);
  const std::vector<Vec3> placed = on_target(found, piece.sketch.points);
  double squares = 0.0;
  for (const Vec3& p : placed) squares += std::pow(tree.nearest(p).distance, 2);
  return root_mean(squares, placed.size(), whole.signature.size);
}

// What became of the pieces of one size.
struct Tally {
  std::size_t pieces = 0, first = 0, among_top = 0, rigid_among_top = 0;
  std::size_t in_place = 0, on_surface = 0;

  [[nodiscard]] double share(std::size_t of) const {
    return static_cast<double>(of) / static_cast<double>(std::max<std::size_t>(pieces, 1));
  }
};

std::size_t rigid_rank(const std::vector<Thing>& wholes, const Thing& piece, std::size_t own) {
  const double score = match_score(wholes[own].signature, piece.signature);
  return static_cast<std::size_t>(std::ranges::count_if(wholes, [&](const Thing& whole) {
    return match_score(whole.signature, piece.signature) > score;
  }));
}

void find_piece(const std::vector<Thing>& wholes, const std::vector<Surface>& surfaces,
                const Thing& piece, std::size_t own, bool same_scale, int threads, Tally& tally) {
  const MatchOptions options{.mode = MatchMode::kPartial, .same_scale = same_scale};
  const Surface surface = surface_of(piece);
  const auto hits = search_partial(
      surface, wholes.size(), [&](std::size_t i) { return surfaces[i]; }, kTop, options, threads);
  ++tally.pieces;
  const auto at = std::ranges::find(hits, own, &Hit::index);
  if (at != hits.end()) {
    ++tally.among_top;
    if (at == hits.begin()) ++tally.first;
  }
  if (rigid_rank(wholes, piece, own) < kTop) ++tally.rigid_among_top;
  constexpr double kInPlace = 0.1;
  constexpr double kOnSurface = 0.08;
  const Match found = match_partial(surfaces[own], surface, options);
  if (off_place(found, wholes[own], piece) < kInPlace) ++tally.in_place;
  if (off_surface(found, wholes[own], piece) < kOnSurface) ++tally.on_surface;
}

void print(const char* unit, double noise, double kept, const Tally& t, double seconds,
           ordered_json& report) {
  fmt::print("{:<12}{:>6g}{:>6.0f} %{:>8}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.3f}{:>10.2f}\n", unit,
             noise, 100.0 * kept, t.pieces, t.share(t.first), t.share(t.among_top),
             t.share(t.on_surface), t.share(t.in_place), t.share(t.rigid_among_top), seconds);
  std::fflush(stdout);
  report["runs"].push_back({{"unit", unit},
                            {"noise", noise},
                            {"kept", kept},
                            {"pieces", t.pieces},
                            {"first", t.share(t.first)},
                            {"among_first_5", t.share(t.among_top)},
                            {"on_surface", t.share(t.on_surface)},
                            {"in_place", t.share(t.in_place)},
                            {"rigid_among_first_5", t.share(t.rigid_among_top)},
                            {"core_seconds_a_search", seconds}});
}

void measure(const RunOptions& options, const std::vector<ClassedShape>& shapes, double noise,
             ordered_json& report) {
  const std::size_t count = shapes.size();
  const auto outcomes = run_isolated(count * kKept.size(), options.threads, [&](std::size_t job) {
    return describe(shapes[job % count], job % count, job / count, noise, options);
  });
  std::vector<std::vector<Thing>> things(kKept.size());
  for (std::size_t job = 0; job < outcomes.size(); ++job) {
    const std::size_t kept = job / count;
    things[kept].push_back(thing_of(outcomes[job], seed_of(options, job % count, kept)));
  }
  for (const bool same_scale : {false, true}) {
    for (std::vector<Thing>& of_size : things) {
      if (same_scale) std::ranges::for_each(of_size, scale_back);
    }
    std::vector<Surface> surfaces;
    for (const Thing& whole : things[0]) surfaces.push_back(surface_of(whole));
    for (std::size_t kept = 1; kept < kKept.size(); ++kept) {
      Tally tally;
      const Stopwatch watch;
      for (std::size_t i = 0; i < count; ++i) {
        find_piece(things[0], surfaces, things[kept][i], i, same_scale, options.threads, tally);
      }
      print(same_scale ? "known scale" : "any scale", noise, kKept[kept], tally,
            watch.core_seconds() / static_cast<double>(std::max<std::size_t>(count, 1)), report);
    }
  }
}

void run(const RunOptions& options) {
  const auto shapes = list_shapes(options.folder, IdFilter::parse(options.ids));
  ordered_json report = report_head("partial", options);
  fmt::print("{:<12}{:>6}{:>8}{:>8}{:>9}{:>9}{:>9}{:>9}{:>9}{:>10}\n", "", "noise", "kept",
             "pieces", "first", "top 5", "on it", "in place", "rigid 5", "core s");
  for (const double noise : options.noise_levels()) measure(options, shapes, noise, report);
  if (!options.json.empty()) write_json(options.json, report);
}

}  // namespace

void add_partial(CLI::App& app) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      app.add_subcommand("partial", "Finds the shapes that pieces of them were cut from");
  add_run_options(*command, *options);
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
