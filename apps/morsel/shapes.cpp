#include "shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <morsel/error.hpp>
#include <morsel/partial.hpp>
#include <morsel/picture.hpp>
#include <system_error>
#include <utility>

#include "options.hpp"
#include "suggest.hpp"

namespace morsel::cli {
namespace {

Subject read_subject(const std::string& file, const ReadOptions& options,
                     const Progress& progress) {
  const PointCloud cloud = read_points(file, options.sample);
  SegmentOptions segment_options;
  segment_options.threads = options.threads;
  const Segmentation result = segment(cloud.points, segment_options, &progress);
  Signature signature = make_signature(result, options.threads);
  if (!(signature.size > 0.0)) {
    throw Error(ErrorCode::kInput, fmt::format("{}: {}", file, result.message));
  }
  return {file == "-" ? "standard input" : file, std::move(signature), make_sketch(result)};
}

constexpr std::size_t kColumns = 5;  // of a sheet

PictureOptions cell_options() {
  PictureOptions options;
  options.width = 240;
  options.views = 1;
  return options;
}

[[noreturn]] void fail_unknown(const std::string& text, const Database* database) {
  if (database == nullptr) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: there is no such file; for a stored name give --database", text));
  }
  std::vector<std::string> names;
  for (ShapeInfo& info : database->list()) names.push_back(std::move(info.name));
  const std::string meant = nearest_name(text, names);
  throw Error(
      ErrorCode::kInput,
      fmt::format("{}: is neither a shape of {} nor a file{}", text, database->file().string(),
                  meant.empty() ? "" : fmt::format("; did you mean {}?", meant)));
}

}  // namespace

void add_comparison_options(CLI::App& command, MatchOptions& match, ReadOptions& read) {
  add_match_options(command, match,
                    {MatchMode::kRigid, MatchMode::kArticulated, MatchMode::kPartial});
  add_mesh_options(command, read.sample);
  add_threads(command, read.threads, "Sampling (meshes only)");
}

Subject stored_subject(const Database& database, const std::string& name) {
  StoredShape shape = database.get(name);
  return {name, std::move(shape.data.signature), std::move(shape.data.sketch)};
}

Subject find_subject(const std::string& text, const Database* database, const ReadOptions& options,
                     const Progress& progress) {
  if (database != nullptr && database->find(text)) return stored_subject(*database, text);
  std::error_code error;
  if (text != "-" && !std::filesystem::exists(text, error)) fail_unknown(text, database);
  return read_subject(text, options, progress);
}

Match match_subjects(const Subject& target, const Subject& source, const MatchOptions& options) {
  if (options.mode != MatchMode::kPartial) {
    return match(target.signature, source.signature, options);
  }
  return match_partial(Surface(target.sketch.points, target.sketch.parts),
                       Surface(source.sketch.points, source.sketch.parts), options);
}

std::string score_bar(double score) {
  constexpr std::size_t kWidth = 20;
  const auto filled = static_cast<std::size_t>(std::lround(kWidth * std::clamp(score, 0.0, 1.0)));
  return std::string(filled, '#') + std::string(kWidth - filled, '.');
}

Image draw_aligned(const Subject& first, const std::vector<Aligned>& others) {
  PictureOptions options = cell_options();
  options.pose_of = first.sketch.points;
  std::vector<Image> cells{render_parts(first.sketch.points, first.sketch.parts, options)};
  std::vector<std::string> captions{first.name};
  for (const Aligned& other : others) {
    const Sketch& sketch = other.shape->sketch;
    cells.push_back(render_parts(on_target(other.match, sketch.points),
                                 parts_on_target(other.match, sketch.parts), options));
    captions.push_back(fmt::format("{:.3f} {}", other.match.score, other.shape->name));
  }
  return make_sheet(cells, captions, std::min(kColumns, cells.size()));
}

Image draw_placed(const Subject& piece, const std::vector<Aligned>& wholes) {
  const PictureOptions options = cell_options();
  std::vector<Image> cells{render_parts(piece.sketch.points, piece.sketch.parts, options)};
  std::vector<std::string> captions{piece.name};
  for (const Aligned& placed : wholes) {
    std::vector<Vec3> points = placed.shape->sketch.points;
    std::vector<int> parts(points.size(), -1);
    const std::vector<Vec3> on_it = on_target(placed.match, piece.sketch.points);
    points.insert(points.end(), on_it.begin(), on_it.end());
    parts.insert(parts.end(), piece.sketch.parts.begin(), piece.sketch.parts.end());
    cells.push_back(render_parts(points, parts, options));
    captions.push_back(fmt::format("{:.3f} {}", placed.match.score, placed.shape->name));
  }
  return make_sheet(cells, captions, std::min(kColumns, cells.size()));
}

std::string join_tags(const std::vector<std::string>& tags) {
  return fmt::format("{}", fmt::join(tags, ", "));
}

}  // namespace morsel::cli
