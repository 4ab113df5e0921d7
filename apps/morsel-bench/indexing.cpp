#include "indexing.hpp"

#include <fmt/format.h>

#include <array>
#include <morsel/database.hpp>
#include <morsel/io.hpp>
#include <string>

#include "base/test_folder.hpp"
#include "isolated.hpp"
#include "solids/families.hpp"
#include "stopwatch.hpp"
#include "summary.hpp"

namespace morsel::bench {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t kPoints = 20000;
constexpr double kNoise = 0.003;  // of every second file

enum Way : std::size_t { kTriangulation, kOneThread, kAllThreads, kWayCount };
constexpr std::array<const char*, kWayCount> kWays{"triangulation", "one_thread", "all_threads"};

ShapeFile write_shape(const std::filesystem::path& folder, std::size_t i) {
  const std::size_t families = solids::family_names().size();
  PointCloud cloud;
  cloud.points =
      solids::sample_member({.family = i % families, .number = i / families, .pose = i},
                            {.count = kPoints, .noise = i % 2 == 0 ? 0.0 : kNoise, .seed = i + 1})
          .points;
  ShapeFile file;
  file.name = fmt::format("{:04}", i);
  file.path = folder / (file.name + ".ply");
  write_points(file.path, cloud, std::vector<int>(cloud.points.size(), 0));
  return file;
}

json run(Way way, const std::vector<ShapeFile>& files, const std::filesystem::path& database,
         const Triangulate& triangulate) {
  std::size_t stored = files.size();
  const Stopwatch watch;
  if (way == kTriangulation) {
    for (const ShapeFile& file : files) triangulate(read_points(file.path).points);
  } else {
    Database fresh = Database::open(database, Access::kCreate);
    IndexOptions options;
    options.segment.threads = way == kOneThread ? 1 : 0;
    stored = index_files(fresh, files, options).added;
  }
  const auto count = static_cast<double>(files.size());
  if (stored != files.size()) {
    throw Error(ErrorCode::kInput, fmt::format("{} of {} files indexed", stored, files.size()));
  }
  return {{"seconds", watch.seconds() / count}, {"core_seconds", watch.core_seconds() / count}};
}

double median_ratio(const json& values, const json& to, const char* what) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < values.size(); ++i) {
    ratios.push_back(values[i].at(what).get<double>() / to[i].at(what).get<double>());
  }
  return median(std::move(ratios));
}

}  // namespace

ordered_json measure_indexing(std::size_t files, std::size_t runs, const Triangulate& triangulate) {
  const TestFolder folder;
  std::vector<std::vector<ShapeFile>> of_run(runs);
  for (std::size_t i = 0; i < files; ++i) {
    of_run[i * runs / files].push_back(write_shape(folder.path(), i));
  }
  const auto outcomes = run_isolated(runs * kWayCount, 1, [&](std::size_t job) {
    const std::size_t of = job / kWayCount;
    const auto way = static_cast<Way>((of + job) % kWayCount);
    const auto database = folder.path() / fmt::format("{}-{}.db", of, kWays[way]);
    return run(way, of_run[of], database, triangulate);
  });
  ordered_json measured = {{"files", files}, {"points", kPoints}};
  for (std::size_t job = 0; job < outcomes.size(); ++job) {
    if (!outcomes[job].error.empty()) throw Error(ErrorCode::kResource, outcomes[job].error);
    const std::size_t way = (job / kWayCount + job) % kWayCount;
    measured["runs"][kWays[way]].emplace_back(outcomes[job].value);
  }
  return measured;
}

void print_indexing(const ordered_json& measured) {
  const json& cgal = measured.at("runs").at(kWays[kTriangulation]);
  const json& one = measured.at("runs").at(kWays[kOneThread]);
  const json& all = measured.at("runs").at(kWays[kAllThreads]);
  std::vector<double> seconds;
  for (const json& each : cgal) seconds.push_back(each.at("core_seconds").get<double>());
  fmt::print(
      "\n{} files of {} points indexed: CGAL's triangulation and reading {:.3f} s of a core a "
      "file\n"
      "  one thread {:.2f} of it, all threads {:.2f} of it by the cores, "
      "{:.2f} times as many files a second as one thread\n",
      measured.at("files").get<std::size_t>(), measured.at("points").get<std::size_t>(),
      median(std::move(seconds)), median_ratio(one, cgal, "core_seconds"),
      median_ratio(all, cgal, "core_seconds"), median_ratio(one, all, "seconds"));
}

}  // namespace morsel::bench
