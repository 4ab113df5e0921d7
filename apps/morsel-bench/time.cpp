// morsel-bench time: points to labels against CGAL's Delaunay insertion alone, pair by pair.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/threads.hpp"
#include "commands.hpp"
#include "solids/solid.hpp"
#include "stopwatch.hpp"
#include "summary.hpp"

namespace morsel::bench {
namespace {

using nlohmann::ordered_json;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;

struct Options {
  std::size_t points = 50000;
  std::size_t runs = 5;
  std::vector<std::filesystem::path> files;
  std::filesystem::path json;
};

struct Input {
  std::string name;
  std::vector<Vec3> points;
};

// What is timed, in each run one after the other.
enum Contender : std::size_t { kCgal, kOneThread, kAllThreads, kContenderCount };

struct Timings {
  std::array<std::vector<double>, kContenderCount> seconds;
  std::vector<std::string> stages;
  std::vector<std::array<std::vector<double>, kContenderCount>> stage_seconds;  // none of CGAL
};

double time_cgal(const std::vector<Kernel::Point_3>& points) {
  const Stopwatch watch;
  Delaunay delaunay;
  delaunay.insert(points.begin(), points.end());
  // Before the triangulation is freed, which is not timed.
  return watch.seconds();
}

double time_segment(const Input& input, int threads, Segmentation& segmentation) {
  SegmentOptions options;
  options.threads = threads;
  options.denoise.threads = threads;
  const Stopwatch watch;
  segmentation = segment(input.points, options);
  return watch.seconds();
}

void add_stages(const Segmentation& segmentation, std::size_t contender, Timings& timings) {
  for (const StageCost& cost : segmentation.costs) {
    const auto found = std::find(timings.stages.begin(), timings.stages.end(), cost.stage);
    const auto index = static_cast<std::size_t>(found - timings.stages.begin());
    if (found == timings.stages.end()) {
      timings.stages.push_back(cost.stage);
      timings.stage_seconds.emplace_back();
    }
    timings.stage_seconds[index][contender].push_back(cost.seconds);
  }
}

// Each run begins with another contender, so that none always follows the same one. The first
// round warms caches and allocator and does not count.
Timings measure(const Input& input, std::size_t runs) {
  std::vector<Kernel::Point_3> points;
  points.reserve(input.points.size());
  for (const Vec3& p : input.points) points.emplace_back(p.x, p.y, p.z);
  Timings timings;
  for (std::size_t run = 0; run <= runs; ++run) {
    for (std::size_t turn = 0; turn < kContenderCount; ++turn) {
      const std::size_t contender = (run + turn) % kContenderCount;
      Segmentation segmentation;
      const double seconds =
          contender == kCgal ? time_cgal(points)
                             : time_segment(input, contender == kOneThread ? 1 : 0, segmentation);
      if (run == 0) continue;
      timings.seconds[contender].push_back(seconds);
      add_stages(segmentation, contender, timings);
    }
  }
  return timings;
}

std::vector<double> ratios(const Timings& timings, Contender contender) {
  std::vector<double> result;
  for (std::size_t run = 0; run < timings.seconds[kCgal].size(); ++run) {
    result.push_back(timings.seconds[contender][run] / timings.seconds[kCgal][run]);
  }
  return result;
}

void print_contender(const std::string& name, const Timings& timings, Contender contender) {
  const std::vector<double> ratio = ratios(timings, contender);
  const auto [least, most] = std::minmax_element(ratio.begin(), ratio.end());
  fmt::print("  {:<28} {:8.3f} s   {:5.2f}  {:5.2f}  {:5.2f}\n", name,
             median(timings.seconds[contender]), *least, median(ratio), *most);
}

void print_timings(const Input& input, const Timings& timings, std::size_t runs) {
  fmt::print("\n{}: {} points, {} runs\n", input.name, input.points.size(), runs);
  fmt::print("  {:<28} {:>10}   ratio: min, median, max\n", "", "median");
  print_contender("CGAL Delaunay insertion", timings, kCgal);
  print_contender("segment, 1 thread", timings, kOneThread);
  print_contender(fmt::format("segment, {} threads", resolve_threads(0)), timings, kAllThreads);
  fmt::print("  stages, medians {:>20} {:>10}   ratio of each to CGAL\n", "1 thread",
             fmt::format("{} threads", resolve_threads(0)));
  const double cgal = median(timings.seconds[kCgal]);
  for (std::size_t i = 0; i < timings.stages.size(); ++i) {
    const double one = median(timings.stage_seconds[i][kOneThread]);
    const double all = median(timings.stage_seconds[i][kAllThreads]);
    fmt::print("    {:<20} {:10.3f} s {:8.3f} s   {:5.2f}  {:5.2f}\n", timings.stages[i], one, all,
               one / cgal, all / cgal);
  }
}

ordered_json to_json(const Input& input, const Timings& timings) {
  ordered_json object = {{"input", input.name},
                         {"points", input.points.size()},
                         {"cgal_seconds", timings.seconds[kCgal]},
                         {"one_thread_seconds", timings.seconds[kOneThread]},
                         {"all_threads_seconds", timings.seconds[kAllThreads]},
                         {"one_thread_ratio", median(ratios(timings, kOneThread))},
                         {"all_threads_ratio", median(ratios(timings, kAllThreads))}};
  for (std::size_t i = 0; i < timings.stages.size(); ++i) {
    object["one_thread_stages"][timings.stages[i]] = timings.stage_seconds[i][kOneThread];
    object["all_threads_stages"][timings.stages[i]] = timings.stage_seconds[i][kAllThreads];
  }
  return object;
}

std::vector<Input> make_inputs(const Options& options) {
  std::vector<Input> inputs;
  for (const auto& file : options.files) {
    inputs.push_back(
        {file.filename().string(),
         read_points(file, {.count = options.points, .noise = 0.0, .seed = 1}).points});
  }
  if (!inputs.empty()) return inputs;
  for (const double noise : {0.0, 0.003}) {
    Input input{fmt::format("bent beast of capsules, noise {:g}", noise),
                solids::sample(solids::beast(), {.count = options.points, .noise = noise}).points};
    solids::bend(input.points);
    inputs.push_back(std::move(input));
  }
  return inputs;
}

void run(const Options& options) {
  ordered_json report = {{"program", "morsel-bench time"},
                         {"version", version()},
                         {"date", utc_now()},
                         {"threads", resolve_threads(0)},
                         {"runs", options.runs}};
  for (const Input& input : make_inputs(options)) {
    const Timings timings = measure(input, options.runs);
    print_timings(input, timings, options.runs);
    report["inputs"].push_back(to_json(input, timings));
  }
  if (!options.json.empty()) write_json(options.json, report);
}

}  // namespace

void add_time(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "time", "Times points to labels against CGAL's Delaunay insertion in the same process");
  command
      ->add_option(
          "FILE", options->files,
          "Point clouds, or meshes to be sampled; none: a procedural shape, clean and noisy")
      ->check(CLI::ExistingFile);
  command->add_option("--points", options->points, "Samples of the shape or of each mesh")
      ->capture_default_str()
      ->check(CLI::Range(4, 100000000));
  command->add_option("--runs", options->runs, "Measured runs after one that warms up")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--json", options->json, "Write all times");
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
