// morsel index --database DB PATH…: stores the signatures of many shapes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "files.hpp"
#include "options.hpp"
#include "shard.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel index --database shapes.db models/              all shapes in and below a folder
  morsel index --database shapes.db a.ply b.ply --tag scanned
  morsel index --database shapes.db models/ --class folder
  morsel index --database shapes.db models/ --class classes.csv
  find . -name '*.off' | morsel index --database shapes.db -
  srun -n 64 morsel index --database postgresql://host/shapes models/
  morsel index --database shapes.db models/ --status     what is done, failed and left

A shape's name is its path as given. Files that did not change are skipped, so an interrupted run
is simply run again. Files that fail are named at the end; the others are stored all the same.
Started by srun, a Slurm job array, mpirun or a Kubernetes indexed job, each process takes its
share of the files, as --shard would say.)";

struct Arguments {
  std::filesystem::path database;
  std::vector<std::string> paths;
  std::string class_from;  // "folder", a CSV file, or empty
  std::vector<std::string> tags;
  std::optional<Shard> shard;
  bool status = false;
  IndexOptions options;
};

// "37 of 200, 2.5/s, 1:05 left"
class Label {
 public:
  explicit Label(std::size_t count) : count_(count) {}

  std::string operator()(std::string_view /*stage*/, double fraction) const {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - began_;
    const double all = static_cast<double>(count_);
    const double done = std::round(fraction * all);
    std::string text = fmt::format("{} of {}", done, count_);
    if (done < 1.0 || passed.count() <= 0.0) return text;
    const double rate = done / passed.count();
    const auto left = std::llround((all - done) / rate);
    return text + fmt::format(", {:.1f}/s, {}:{:02} left", rate, left / 60, left % 60);
  }

 private:
  std::size_t count_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

std::vector<ShapeFile> files_of(const Arguments& arguments) {
  std::vector<ShapeFile> files = collect_files(arguments.paths);
  for (ShapeFile& file : files) file.tags = arguments.tags;
  if (arguments.class_from == "folder") {
    assign_folders(files);
  } else if (!arguments.class_from.empty()) {
    const std::size_t without = assign_classes(files, read_classes(arguments.class_from));
    if (without > 0) {
      complain(fmt::format("note: {} of {} files have no class in {}", without, files.size(),
                           arguments.class_from));
    }
  }
  return files;
}

// Most reasons begin with the file already.
void complain_of(const IndexFailure& failure) {
  const std::string path = failure.path.string();
  complain(failure.reason.starts_with(path + ":") ? failure.reason : path + ": " + failure.reason);
}

// What is done of the files, failed and left, as of now.
int show_status(const std::vector<ShapeFile>& files, const std::filesystem::path& place) {
  const Database database = Database::open(place, Access::kRead);
  const auto stored = database.shapes();
  const std::map<std::string, std::string> reasons = database.failures();
  std::vector<std::string> failed;
  std::vector<std::string> left;
  for (const ShapeFile& file : files) {
    const auto reason = reasons.find(file.name);
    const auto at = std::lower_bound(
        stored->begin(), stored->end(), file.name,
        [](const ShapeInfo& info, const std::string& name) { return info.name < name; });
    if (reason != reasons.end()) {
      failed.push_back(fmt::format("failed  {}: {}\n", file.name, reason->second));
    } else if (at == stored->end() || at->name != file.name) {
      left.push_back(fmt::format("left    {}\n", file.name));
    }
  }
  say(fmt::format("{}: of {} files {} are done, {} failed, {} are left\n{}{}",
                  database.file().string(), files.size(),
                  files.size() - failed.size() - left.size(), failed.size(), left.size(),
                  fmt::join(failed, ""), fmt::join(left, "")));
  return kDone;
}

int run_index(const Arguments& arguments) {
  std::vector<ShapeFile> files = files_of(arguments);
  const bool whole = arguments.status && !arguments.shard;
  const std::optional<Shard> shard = whole             ? std::nullopt
                                     : arguments.shard ? arguments.shard
                                                       : shard_of_engine();
  if (shard) files = part_of(files, *shard);
  if (arguments.status) return show_status(files, arguments.database);
  Database database = Database::open(arguments.database, Access::kCreate);
  Task task{Label(files.size())};
  const IndexReport report = index_files(database, files, arguments.options, &task.progress());
  task.begin_writing();
  if (shard) say(fmt::format("shard {} of {}: ", shard->index, shard->count));
  say(fmt::format("{}: {} added, {} replaced, {} unchanged; {} shapes in all\n",
                  database.file().string(), report.added, report.replaced, report.unchanged,
                  database.size()));
  if (report.without_inside > 0) {
    complain(fmt::format("note: {} of them bound no inside and are compared by their points alone",
                         report.without_inside));
  }
  for (const IndexFailure& failure : report.failures) complain_of(failure);
  if (report.failures.empty()) return kDone;
  complain(fmt::format("{} of {} files could not be stored", report.failures.size(), files.size()));
  return kBadInput;
}

}  // namespace

void add_index(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("index", "Store shapes in a database");
  const auto arguments = std::make_shared<Arguments>();
  command
      ->add_option("PATH", arguments->paths,
                   "Files and folders; - reads a list from standard input")
      ->required()
      ->option_text("...");
  add_database(*command, arguments->database);
  add(*command, "--class", "folder|FILE.csv", "Classes: the folders' names, or lines name,class",
      [arguments](const std::string& name, const std::string& text) {
        if (text.empty()) throw CLI::ValidationError(name, "the file name is empty");
        arguments->class_from = text;
      });
  command->add_option("--tag", arguments->tags, "Tag the shapes; may be given again")
      ->option_text("TAG")
      ->allow_extra_args(false);
  add(*command, "--shard", "I/N", "Only the Ith of N shares of the files, counted from 0",
      [arguments](const std::string& name, const std::string& text) {
        arguments->shard = read_shard(name, text);
      });
  command->add_flag("--status", arguments->status,
                    "Store nothing; say which files are done, failed and left");
  add_method_options(*command, arguments->options.segment);
  add_mesh_options(*command, arguments->options.sample);
  command->footer(kExamples);
  command->group("Database");
  command->callback([command, arguments, &chosen] {
    check_method_options(*command, arguments->options.segment);
    chosen = [arguments] { return run_index(*arguments); };
  });
}

}  // namespace morsel::cli
