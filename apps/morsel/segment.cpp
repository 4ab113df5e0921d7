// morsel segment FILE: the parts of one shape, as a table or as files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <morsel/morsel.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "numbers.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

constexpr const char* kExamples = R"(Examples:
  morsel segment scan.ply                           a table of the parts
  morsel segment scan.ply --html parts.html         a page to turn and cut the parts in
  morsel segment scan.ply -o parts.ply --picture parts.png
  morsel segment scan.xyz --parts 5 --labels labels.txt
  morsel segment chair.off --sample 50000 --noise 0.003 --report chair.json
  zcat scan.xyz.gz | morsel segment - --labels labels.txt

Exit status: 0 done, 2 wrong usage, 3 file that cannot be read or written, 4 no solid found,
130 interrupted, 1 internal error. 'man morsel' has more.)";

struct Arguments {
  std::string file;
  SampleOptions sample;
  SegmentOptions options;
  Output labels{"--labels", {}, {}};
  Output points{"--output", {}, {".ply", ".pcd", ".xyz", ".npz"}};
  Output report{"--report", {}, {".json"}};
  Output picture{"--picture", {}, {".png", ".svg"}};
  Output html{"--html", {}, {".html", ".htm"}};
  std::vector<std::string> mesh_options;  // the options given that a point cloud has no use for

  [[nodiscard]] std::vector<Output> outputs() const {
    return {labels, points, report, picture, html};
  }
  [[nodiscard]] bool any_output() const {
    return std::ranges::any_of(outputs(), [](const Output& o) { return !o.path.empty(); });
  }
};

// ---- options -----------------------------------------------------------------------------------

void add_cut_options(CLI::App& app, CutOptions& cut) {
  CLI::Option* const parts = add(app, "--parts", "K", "This many parts [the program decides]",
                                 [&cut](const std::string& name, const std::string& text) {
                                   cut.parts = whole_number(name, text, 1, std::uint64_t{1} << 31);
                                 })
                                 ->group("Parts");
  add(app, "--merge-ratio", "R", "Merge parts below this ratio, 1 or more; larger is coarser",
      [&cut](const std::string& name, const std::string& text) {
        cut.merge_ratio = number(name, text, {1.0, kUnbounded});
      })
      ->group("Parts")
      ->excludes(parts);
}

void add_outputs(CLI::App& app, Arguments& arguments) {
  add_output(app, "--labels", "FILE", arguments.labels, "Part of each input point, one a line");
  add_output(app, "-o,--output", "FILE", arguments.points,
             "Coloured points with their part: .ply .pcd .xyz .npz");
  add_output(app, "--report", "FILE.json", arguments.report, "Everything that was measured");
  add_output(app, "--picture", "FILE", arguments.picture, "Drawing of the parts: .png .svg");
  add_output(app, "--html", "FILE.html", arguments.html,
             "Page with the parts in 3D, for a browser");
}

// Refuses options that the chosen method would ignore, and notes those that a cloud would.
void check_combinations(const CLI::App& app, Arguments& arguments) {
  if (arguments.file.empty()) throw CLI::ValidationError("FILE", "the file name is empty");
  if (!arguments.html.path.empty() && !has_html_viewer()) {
    throw CLI::ValidationError("--html",
                               "this build of morsel has no viewer; install Node.js and "
                               "npm and build it again");
  }
  check_method_options(app, arguments.options);
  arguments.mesh_options = given_mesh_options(app);
}

// ---- results -----------------------------------------------------------------------------------

// "1 4 7", cut short where a table would break.
std::string neighbor_list(const Part& part) {
  constexpr std::size_t kMost = 8;
  std::string list;
  for (std::size_t i = 0; i < std::min(kMost, part.neighbors.size()); ++i) {
    list += fmt::format("{}{}", i == 0 ? "" : " ", part.neighbors[i].part);
  }
  if (part.neighbors.size() > kMost) list += fmt::format(" +{}", part.neighbors.size() - kMost);
  return list.empty() ? "-" : list;
}

std::string table(const Segmentation& result) {
  constexpr std::size_t kMost = 24;
  const std::vector<Part>& parts = result.parts.parts;
  double volume = 0.0;
  std::size_t points = 0;
  for (const Part& part : parts) {
    volume += part.volume;
    points += part.point_count;
  }
  const auto percent = [](double share, double all) { return all > 0 ? 100.0 * share / all : 0.0; };
  const bool several = result.tree.component_count > 1;
  std::string text =
      fmt::format("part  {}volume %  points %  thickness  neighbours\n", several ? "object  " : "");
  for (std::size_t i = 0; i < std::min(kMost, parts.size()); ++i) {
    const Part& part = parts[i];
    const std::string object = several ? fmt::format("{:6}  ", part.object) : "";
    text += fmt::format("{:4}  {}{:8.1f}  {:8.1f}  {:9.4g}  {}\n", i, object,
                        percent(part.volume, volume),
                        percent(static_cast<double>(part.point_count), static_cast<double>(points)),
                        2.0 * part.ball_radius, neighbor_list(part));
  }
  if (parts.size() > kMost) text += fmt::format("  …  and {} smaller\n", parts.size() - kMost);
  return text;
}

constexpr const char* kHint =
    "To look at them: --html parts.html\n"
    "To keep them: -o parts.ply, --labels labels.txt, --report report.json, --picture parts.png\n";

struct Written {
  const Output* output;
  std::string what;
  std::function<void(const std::filesystem::path&)> write;
};

// Writes what was asked for, a line each. A file that fails does not take the others with it.
int write_all(const std::vector<Written>& files, const Progress& progress) {
  int status = kDone;
  for (const Written& file : files) {
    const std::filesystem::path& path = file.output->path;
    if (path.empty()) continue;
    progress.check();
    try {
      file.write(path);
      say(fmt::format("wrote {} ({})\n", path.string(), file.what));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kOutput) throw;
      complain(error.what());
      status = kBadInput;
    }
  }
  return status;
}

std::string name_of_input(const Arguments& arguments) {
  return arguments.file == "-" ? "standard input"
                               : std::filesystem::path(arguments.file).filename().string();
}

// What to write, the quickest first.
std::vector<Written> results(const Arguments& arguments, const PointCloud& cloud,
                             const Segmentation& result) {
  const Written report{&arguments.report, "report", [&](const std::filesystem::path& path) {
                         write_text(path, report_json(result, arguments.options, arguments.file));
                       }};
  if (result.verdict != Verdict::kSolid) return {report};
  const std::string count = fmt::format("{} points", cloud.points.size());
  return {report,
          {&arguments.labels, "labels of " + count,
           [&](const std::filesystem::path& path) { write_labels(path, result.labels); }},
          {&arguments.points, count,
           [&](const std::filesystem::path& path) { write_points(path, cloud, result.labels); }},
          {&arguments.picture, "picture",
           [&](const std::filesystem::path& path) {
             PictureOptions options;
             const std::size_t parts = result.parts.parts.size();
             options.title = fmt::format("{}: {} part{}", name_of_input(arguments), parts,
                                         parts == 1 ? "" : "s");
             write_picture(path, cloud.points, result.labels, options);
           }},
          {&arguments.html, "page for a browser", [&](const std::filesystem::path& path) {
             HtmlOptions options;
             options.name = name_of_input(arguments);
             options.merge_ratio = result.parts.merge_ratio;
             write_html(path, cloud.points, result.tree, options);
           }}};
}

// ---- the command -------------------------------------------------------------------------------

// Options of meshes do nothing to a point cloud; better said than left for a riddle.
void note_unused_options(const Arguments& arguments) {
  if (arguments.mesh_options.empty()) return;
  std::error_code error;
  // A pipe can be read only once.
  const bool readable_twice = std::filesystem::is_regular_file(arguments.file, error);
  if (arguments.file != "-" && (!readable_twice || is_mesh_file(arguments.file))) return;
  complain(fmt::format("note: {} of no effect: {} holds points, not a mesh",
                       fmt::join(arguments.mesh_options, ", "), name_of_input(arguments)));
}

// A count that the shape does not have must not pass as what was asked for.
void note_other_count(const Arguments& arguments, const Segmentation& result) {
  const std::size_t count = result.parts.parts.size();
  const std::size_t asked = arguments.options.cut.parts.value_or(count);
  if (asked == count) return;
  complain(fmt::format("note: --parts {}: the shape can be cut into {} {} parts", asked,
                       asked > count ? "at most" : "no fewer than", count));
}

int run_segment(const Arguments& arguments) {
  check_outputs(arguments.outputs(), arguments.file);
  note_unused_options(arguments);
  const PointCloud cloud = read_points(arguments.file, arguments.sample);
  Task task;
  const Segmentation result = segment(cloud.points, arguments.options, &task.progress());
  task.begin_writing();
  const bool solid = result.verdict == Verdict::kSolid;
  if (solid) {
    say(fmt::format("{}: {}\n", name_of_input(arguments), result.message));
    note_other_count(arguments, result);
  } else {
    complain(fmt::format("{}: {}", name_of_input(arguments), result.message));
  }
  const int written = write_all(results(arguments, cloud, result), task.progress());
  if (!solid) return written == kDone ? kNoSolid : written;
  if (!arguments.any_output()) say("\n" + table(result) + "\n" + kHint);
  return written;
}

}  // namespace

void add_segment(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("segment", "Cut a shape into its parts");
  const auto arguments = std::make_shared<Arguments>();
  command
      ->add_option("FILE", arguments->file, "Point cloud or mesh; - reads XYZ from standard input")
      ->required()
      ->option_text(" ");
  add_outputs(*command, *arguments);
  add_cut_options(*command, arguments->options.cut);
  add_method_options(*command, arguments->options);
  add_mesh_options(*command, arguments->sample);
  command->footer(kExamples);
  command->group("Commands");
  command->callback([command, arguments, &chosen] {
    check_combinations(*command, *arguments);
    chosen = [arguments] { return run_segment(*arguments); };
  });
}

}  // namespace morsel::cli
