// morsel-bench scaling: points to labels, parts and signature against CGAL's Delaunay insertion
// alone, from some thousands of points to millions: seconds, memory, growth, how soon it stops when
// asked to, many files at once, and what became slower than it was.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/iterator/transform_iterator.hpp>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/memory.hpp"
#include "base/threads.hpp"
#include "commands.hpp"
#include "indexing.hpp"
#include "isolated.hpp"
#include "solids/solid.hpp"
#include "stopwatch.hpp"
#include "summary.hpp"

namespace morsel::bench {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;

struct Options {
  std::vector<std::size_t> points{10000, 100000, 1000000};
  std::vector<double> noise{0.0, 0.003};
  std::size_t runs = 5;
  std::size_t indexed = 200;
  std::vector<std::filesystem::path> files;
  std::filesystem::path json;
  std::filesystem::path against;
};

// What is timed, in each run one after the other.
enum Contender : std::size_t { kCgal, kOneThread, kAllThreads, kContenderCount };
constexpr std::array<const char*, kContenderCount> kNames{"cgal", "one_thread", "all_threads"};

struct Input {
  std::string name;
  std::size_t points = 0;
  double noise = 0.0;
  std::filesystem::path file;  // empty: the procedural shape
};

void insert_all(Delaunay& delaunay, const std::vector<Vec3>& points) {
  const auto convert = [](const Vec3& p) { return Kernel::Point_3(p.x, p.y, p.z); };
  delaunay.insert(boost::make_transform_iterator(points.begin(), convert),
                  boost::make_transform_iterator(points.end(), convert));
}

json run_cgal(const std::vector<Vec3>& points) {
  const Stopwatch watch;
  Delaunay delaunay;
  insert_all(delaunay, points);
  // Before the triangulation is freed, which is not timed.
  return {{"seconds", watch.seconds()}, {"bytes", peak_memory()}};
}

json run_morsel(const std::vector<Vec3>& points, int threads) {
  SegmentOptions options;
  options.threads = threads;
  const Stopwatch watch;
  const Segmentation segmentation = segment(points, options);
  const double parts_ready = watch.seconds();
  const Signature signature =
      make_signature(segmentation.complex, segmentation.basins, segmentation.parts, threads);
  json result = {{"seconds", watch.seconds()},
                 {"bytes", peak_memory()},
                 {"vertices", segmentation.complex.vertices.size()},
                 {"parts", segmentation.parts.parts.size()}};
  for (const StageCost& cost : segmentation.costs) result["stages"][cost.stage] = cost.seconds;
  result["stages"]["signature"] = watch.seconds() - parts_ready;
  CutOptions five;
  five.parts = 5;
  const Stopwatch again;
  const Parts parts = cut(segmentation.tree, five);
  result["recut"] = again.seconds();
  return result;
}

// Seconds from being asked to stop to having stopped, asked at moments spread evenly over the work.
json run_cancelled(const std::vector<Vec3>& points) {
  constexpr int kMoments = 20;
  using Clock = std::chrono::steady_clock;
  const Stopwatch watch;
  (void)segment(points);
  const std::chrono::duration<double> whole(watch.seconds());
  json answers = json::array();
  for (int i = 0; i < kMoments; ++i) {
    Progress progress;
    Clock::time_point asked;
    Clock::time_point stopped = Clock::time_point::min();
    {
      const std::jthread other([&, begin = Clock::now()] {
        std::this_thread::sleep_until(begin + (i + 0.5) / kMoments * whole);
        asked = Clock::now();
        progress.cancel();
      });
      try {
        (void)segment(points, {}, &progress);
      } catch (const Error&) {
        stopped = Clock::now();
      }
    }
    if (stopped < asked) continue;  // it was done before
    answers.push_back(std::chrono::duration<double>(stopped - asked).count());
  }
  return answers;
}

// All that was measured on one input: of each contender, one value a run.
struct Measured {
  std::vector<std::vector<json>> runs;  // of each contender
  std::vector<double> answers;          // to being asked to stop, in seconds

  [[nodiscard]] std::vector<double> of(Contender contender, const json::json_pointer& what) const {
    std::vector<double> values;
    for (const json& run : runs[contender]) values.push_back(run.at(what).get<double>());
    return values;
  }
  [[nodiscard]] double middle(Contender contender, const std::string& what) const {
    return median(of(contender, json::json_pointer(what)));
  }
  // Median of what it took in multiples of CGAL, pair by pair.
  [[nodiscard]] double ratio(Contender contender, const std::string& what) const {
    return median_ratio(of(contender, json::json_pointer(what)),
                        of(kCgal, json::json_pointer("/seconds")));
  }
  [[nodiscard]] double memory_ratio() const {
    return middle(kAllThreads, "/bytes") / middle(kCgal, "/bytes");
  }
  [[nodiscard]] double slowest_answer() const {
    return answers.empty() ? 0.0 : *std::ranges::max_element(answers);
  }
  // Of one thread, all but the triangulation and what comes before it.
  [[nodiscard]] double rest() const {
    constexpr std::array<std::string_view, 4> kBefore{"sort", "ground", "denoise", "triangulate"};
    double sum = 0.0;
    for (const auto& stage : runs[kOneThread].front().at("stages").items()) {
      if (std::ranges::count(kBefore, stage.key()) > 0) continue;
      sum += ratio(kOneThread, "/stages/" + stage.key());
    }
    return sum;
  }
};

std::vector<Vec3> points_of(const Input& input) {
  if (!input.file.empty()) {
    return read_points(input.file, {.count = input.points, .noise = input.noise, .seed = 1}).points;
  }
  std::vector<Vec3> points =
      solids::sample(solids::beast(), {.count = input.points, .noise = input.noise}).points;
  solids::bend(points);
  return points;
}

// Each run in a process of its own, so that each has a peak of its own.
Measured measure(const Input& input, std::size_t runs) {
  const std::vector<Vec3> points = points_of(input);
  Measured measured;
  measured.runs =
      run_in_turns(kContenderCount, runs, [&](std::size_t contender, std::size_t /*run*/) {
        return contender == kCgal ? run_cgal(points)
                                  : run_morsel(points, contender == kOneThread ? 1 : 0);
      });
  measured.answers =
      run_in_turns(1, 1, [&](std::size_t, std::size_t) { return run_cancelled(points); })[0][0]
          .get<std::vector<double>>();
  return measured;
}

void print_row(const Input& input, const Measured& measured) {
  fmt::print(
      "{:>9} {:>9.0f} {:>9.3f} {:>8.2f} {:>9.2f} {:>6.2f} {:>8.0f} {:>7.2f} {:>9.2f} {:>8.0f}\n",
      input.points, measured.middle(kAllThreads, "/vertices"), measured.middle(kCgal, "/seconds"),
      measured.ratio(kOneThread, "/seconds"), measured.ratio(kAllThreads, "/seconds"),
      measured.rest(), 1e-6 * measured.middle(kCgal, "/bytes"), measured.memory_ratio(),
      1e3 * measured.middle(kAllThreads, "/recut"), 1e3 * measured.slowest_answer());
}

void print_stages(const Measured& measured) {
  std::vector<std::string> stages;
  for (const auto& stage : measured.runs[kOneThread].front().at("stages").items()) {
    const std::string what = "/stages/" + stage.key();
    stages.push_back(fmt::format("{} {:.2f} {:.2f}", stage.key(), measured.ratio(kOneThread, what),
                                 measured.ratio(kAllThreads, what)));
  }
  fmt::print("  stages in multiples of CGAL, with one thread and with all: {}\n",
             fmt::join(stages, ", "));
}

ordered_json to_json(const Input& input, const Measured& measured) {
  ordered_json object = {{"input", input.name},
                         {"points", input.points},
                         {"noise", input.noise},
                         {"one_thread_ratio", measured.ratio(kOneThread, "/seconds")},
                         {"all_threads_ratio", measured.ratio(kAllThreads, "/seconds")},
                         {"rest_ratio", measured.rest()},
                         {"memory_ratio", measured.memory_ratio()},
                         {"seconds_to_stop", measured.answers}};
  for (std::size_t i = 0; i < kContenderCount; ++i) object["runs"][kNames[i]] = measured.runs[i];
  return object;
}

// Slope of log seconds over log points, least squares.
double growth(const std::vector<std::pair<double, double>>& points_seconds) {
  double x = 0.0;
  double y = 0.0;
  for (const auto& [n, t] : points_seconds) {
    x += std::log(n) / static_cast<double>(points_seconds.size());
    y += std::log(t) / static_cast<double>(points_seconds.size());
  }
  double xy = 0.0;
  double xx = 0.0;
  for (const auto& [n, t] : points_seconds) {
    xy += (std::log(n) - x) * (std::log(t) - y);
    xx += (std::log(n) - x) * (std::log(n) - x);
  }
  return xy / xx;
}

// Prints what is more than 10% above the record, and throws if anything is.
void compare(const ordered_json& report, const std::filesystem::path& record) {
  constexpr double kSlower = 1.1;
  std::ifstream file(record);
  const json old = json::parse(file, nullptr, false);
  if (old.is_discarded() || !old.contains("inputs")) {
    throw Error(ErrorCode::kInput,
                record.string() + ": no record of ratios; write one with 'scaling --json'");
  }
  std::size_t slower = 0;
  std::size_t compared = 0;
  for (const auto& now : report.at("inputs")) {
    for (const json& then : old.at("inputs")) {
      if (then.at("input") != now.at("input") || then.at("points") != now.at("points")) continue;
      for (const char* what :
           {"one_thread_ratio", "all_threads_ratio", "rest_ratio", "memory_ratio"}) {
        const double is = now.at(what).get<double>();
        const double was = then.at(what).get<double>();
        ++compared;
        if (is <= kSlower * was) continue;
        ++slower;
        fmt::print("{}, {} points: {} is {:.2f}, was {:.2f}\n", now.at("input").get<std::string>(),
                   now.at("points").get<std::size_t>(), what, is, was);
      }
    }
  }
  const std::string summary = fmt::format("{} of {} ratios are more than 10% above those of {}",
                                          slower, compared, record.string());
  if (slower > 0 || compared == 0) throw Error(ErrorCode::kInput, summary);
  fmt::print("{}\n", summary);
}

std::vector<Input> make_inputs(const Options& options, std::size_t which) {
  std::vector<Input> inputs;
  for (const std::size_t count : options.points) {
    if (which < options.files.size()) {
      const auto& file = options.files[which];
      inputs.push_back({file.filename().string(), count, 0.0, file});
    } else {
      const double noise = options.noise[which - options.files.size()];
      inputs.push_back(
          {fmt::format("bent beast of capsules, noise {:g}", noise), count, noise, {}});
    }
  }
  return inputs;
}

void run(const Options& options) {
  ordered_json report = {{"program", "morsel-bench scaling"},
                         {"version", version()},
                         {"date", utc_now()},
                         {"threads", resolve_threads(0)},
                         {"runs", options.runs},
                         {"inputs", ordered_json::array()}};
  const std::size_t shapes = options.files.empty() ? options.noise.size() : options.files.size();
  for (std::size_t which = 0; which < shapes; ++which) {
    const auto inputs = make_inputs(options, which);
    fmt::print("\n{}, {} runs each, {} threads; ratios to CGAL\n", inputs.front().name,
               options.runs, resolve_threads(0));
    fmt::print("{:>9} {:>9} {:>9} {:>8} {:>9} {:>6} {:>8} {:>7} {:>9} {:>8}\n", "points", "kept",
               "CGAL, s", "1 thread", "threads", "rest", "CGAL, MB", "memory", "recut, ms",
               "stop, ms");
    std::vector<std::pair<double, double>> cgal;
    std::vector<std::pair<double, double>> ours;
    for (const Input& input : inputs) {
      const Measured measured = measure(input, options.runs);
      print_row(input, measured);
      if (&input == &inputs.back()) print_stages(measured);
      cgal.emplace_back(input.points, measured.middle(kCgal, "/seconds"));
      ours.emplace_back(input.points, measured.middle(kAllThreads, "/seconds"));
      report["inputs"].push_back(to_json(input, measured));
    }
    if (inputs.size() > 1) {
      fmt::print("  time grows as n^{:.2f}, CGAL's as n^{:.2f}\n", growth(ours), growth(cgal));
    }
  }
  if (options.indexed > 0) {
    report["indexing"] =
        measure_indexing(options.indexed, options.runs, [](const std::vector<Vec3>& points) {
          Delaunay delaunay;
          insert_all(delaunay, points);
        });
    print_indexing(report["indexing"]);
  }
  if (!options.json.empty()) write_json(options.json, report);
  if (!options.against.empty()) compare(report, options.against);
}

}  // namespace

void add_scaling(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "scaling", "Times points to labels, parts and signature against CGAL's Delaunay insertion");
  command->add_option("FILE", options->files, "Meshes to be sampled; none: a procedural shape")
      ->check(CLI::ExistingFile);
  command->add_option("--points", options->points, "Samples of the shape or of each mesh")
      ->capture_default_str()
      ->check(CLI::Range(1000, 100000000));
  command
      ->add_option("--noise", options->noise,
                   "Noise of the procedural shape as a fraction of the bounding-box diagonal")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 0.1));
  command->add_option("--runs", options->runs, "Runs of each, in turns, a process each")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command
      ->add_option("--files", options->indexed,
                   "Files of 20,000 points that are indexed, a share of them a run; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0, 100000));
  command->add_option("--json", options->json, "Write all that was measured");
  command
      ->add_option("--against", options->against,
                   "An earlier --json: say which ratios are more than 10% above it, and fail")
      ->check(CLI::ExistingFile);
  command->footer(
      "Kept are the points that were triangulated. Rest is what one thread needs apart from\n"
      "sorting, ground, denoising and triangulation. Memory is the peak of the whole process. "
      "Stop\n"
      "is the longest that it went on after it was asked to stop, at 20 moments.");
  command->callback([options] { run(*options); });
}

}  // namespace morsel::bench
