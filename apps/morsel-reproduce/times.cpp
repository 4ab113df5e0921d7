// The table of times: as many points as in the paper.
#include <fmt/format.h>

#include <array>

#include "describe.hpp"
#include "sections.hpp"
#include "stopwatch.hpp"
#include "summary.hpp"

namespace morsel::reproduce {
namespace {

using nlohmann::ordered_json;

// Table of the paper, on a Pentium 4 of 2.8 GHz; and the shape of ours that comes nearest.
struct Row {
  const char* name;
  std::size_t points;
  double seconds;
  const char* file;
};
constexpr std::array<Row, 6> kRows{{{"CAD", 11000, 19.8, "meshes/joint.off"},
                                    {"Pig", 37000, 232, "meshes/pig.off"},
                                    {"Tiger", 44000, 399, "meshes/cow.off"},
                                    {"Dog", 55000, 475, "meshes/bull.off"},
                                    {"Boy", 91000, 1049, "meshes/man.off"},
                                    {"Alien", 120000, 1455, "meshes/dino.off"}}};

std::vector<Vec3> points_of(const Study& study, const Row& row, std::size_t count) {
  const std::filesystem::path file = study.options.data / row.file;
  if (!study.options.data.empty() && exists(file)) {
    return read_points(file, {.count = count}).points;
  }
  return make_shape({.family = 0, .number = row.points}, {.points = count}).points;
}

double median_seconds(const std::vector<Vec3>& points, SegmentOptions options, int threads,
                      std::size_t runs) {
  options.threads = threads;
  options.denoise.threads = threads;
  std::vector<double> seconds;
  for (std::size_t run = 0; run < runs; ++run) {
    const bench::Stopwatch watch;
    const Segmentation result = segment(points, options);
    seconds.push_back(watch.seconds());
  }
  return bench::median(std::move(seconds));
}

}  // namespace

void add_times(Study& study) {
  ordered_json rows = ordered_json::array();
  const std::size_t runs = study.amount(3, 1);
  for (const Row& row : kRows) {
    const std::vector<Vec3> points =
        points_of(study, row, study.amount(row.points, row.points / 20));
    const double all = median_seconds(points, default_options(), 0, runs);
    const double one = median_seconds(points, default_options(), 1, runs);
    const double rules = median_seconds(points, paper_options(), 0, runs);
    rows.push_back({{"paper_shape", row.name},
                    {"paper_seconds", row.seconds},
                    {"shape", study.options.data.empty() ? "generated" : row.file},
                    {"points", points.size()},
                    {"seconds", all},
                    {"one_thread_seconds", one},
                    {"paper_rules_seconds", rules},
                    {"factor", row.seconds / all}});
    say(fmt::format("  {} points: {:.2f} s, in the paper {:g} s", points.size(), all, row.seconds));
  }
  study.figures["times"] = {{"runs", runs}, {"rows", std::move(rows)}};
}

}  // namespace morsel::reproduce
