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

std::vector<double> of(const ordered_json& measured, Way way, const char* what) {
  std::vector<double> values;
  for (const auto& run : measured.at("runs").at(kWays[way])) values.push_back(run.at(what));
  return values;
}

}  // namespace

ordered_json measure_indexing(std::size_t files, std::size_t runs, const Triangulate& triangulate) {
  const TestFolder folder;
  std::vector<std::vector<ShapeFile>> of_run(runs);
  for (std::size_t i = 0; i < files; ++i) {
    of_run[i * runs / files].push_back(write_shape(folder.path(), i));
  }
  const auto values = run_in_turns(kWayCount, runs, [&](std::size_t way, std::size_t number) {
    const auto database = folder.path() / fmt::format("{}-{}.db", number, kWays[way]);
    return run(static_cast<Way>(way), of_run[number], database, triangulate);
  });
  ordered_json measured = {{"files", files}, {"points", kPoints}};
  for (std::size_t way = 0; way < kWayCount; ++way) measured["runs"][kWays[way]] = values[way];
  return measured;
}

void print_indexing(const ordered_json& measured) {
  const std::vector<double> cgal = of(measured, kTriangulation, "core_seconds");
  fmt::print(
      "\n{} files of {} points indexed: CGAL's triangulation and reading {:.3f} s of a core a "
      "file\n"
      "  one thread {:.2f} of it, all threads {:.2f} of it by the cores, "
      "{:.2f} times as many files a second as one thread\n",
      measured.at("files").get<std::size_t>(), measured.at("points").get<std::size_t>(),
      median(cgal), median_ratio(of(measured, kOneThread, "core_seconds"), cgal),
      median_ratio(of(measured, kAllThreads, "core_seconds"), cgal),
      median_ratio(of(measured, kOneThread, "seconds"), of(measured, kAllThreads, "seconds")));
}

}  // namespace morsel::bench
