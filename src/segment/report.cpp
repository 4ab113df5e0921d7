// The report of a segmentation as JSON.

#include <array>
#include <cmath>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>

namespace morsel {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

const char* verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kSolid:
      return "solid";
    case Verdict::kTooFewPoints:
      return "too few points";
    case Verdict::kFlat:
      return "flat";
    case Verdict::kNotSolid:
      return "not solid";
  }
  return "";
}

Json options_json(const SegmentOptions& options, const Segmentation& s) {
  Json json;
  const bool paper = options.interior.method == Method::kPaper;
  json["method"] = paper ? "paper" : "default";
  if (paper) {
    json["big_ball_ratio"] = options.interior.big_ball_ratio;
    json["deep_angle_degrees"] = options.interior.deep_angle;
  } else {
    json["denoise"] = options.denoise.rounds ? Json(*options.denoise.rounds) : Json("auto");
    json["ground"] = ground_mode_name(options.ground.mode);
  }
  if (options.cut.parts) json["parts"] = *options.cut.parts;
  if (s.verdict == Verdict::kSolid) json["merge_ratio"] = s.parts.merge_ratio;
  return json;
}

// Null without a ground.
Json ground_json(const Segmentation& s) {
  if (!s.ground.plane) return nullptr;
  return {{"normal", vector_json(s.ground.plane->normal)},
          {"offset", s.ground.plane->offset},
          {"thickness", s.ground.plane->thickness},
          {"points", s.ground.count_apart()}};
}

Json counts_json(const Segmentation& s) {
  return {{"points", s.denoised.stand_in.size()},  {"outliers", s.denoised.outlier_count},
          {"vertices", s.complex.vertices.size()}, {"cells", s.complex.cell_count()},
          {"inner_cells", s.interior.inner_cells}, {"outer_cells", s.interior.outer_cells},
          {"stray_cells", s.basins.stray_cells},   {"basins", s.basins.count()},
          {"pieces", s.tree.moments.size()},       {"objects", s.tree.component_count},
          {"parts", s.parts.parts.size()}};
}

// `points`: of all objects.
Json part_json(const Part& part, int index, const Segmentation& s, std::size_t points) {
  Json json;
  json["part"] = index;
  json["object"] = part.object;
  json["volume"] = part.volume;
  json["volume_share"] = part.volume / s.interior.volume;
  json["representative_point"] = vector_json(part.center);
  json["covariance"] = part.covariance;
  json["largest_ball"] = {{"center", vector_json(part.ball_center)}, {"radius", part.ball_radius}};
  json["points"] = part.point_count;
  json["point_share"] = static_cast<double>(part.point_count) / static_cast<double>(points);
  json["neighbors"] = Json::array();
  for (const PartNeighbor& neighbor : part.neighbors) {
    json["neighbors"].push_back({{"part", neighbor.part}, {"neck_radius", neighbor.neck_radius}});
  }
  return json;
}

Json openings_json(const std::vector<Opening>& openings) {
  Json json = Json::array();
  for (const Opening& opening : openings) {
    json.push_back({{"center", vector_json(opening.center)}, {"radius", opening.radius}});
  }
  return json;
}

// `stability` is the factor of merge ratios over which the count stays the same; null: for ever.
Json levels_json(const MergeTree& tree) {
  Json levels = Json::array();
  for (const MergeTree::Level& level : tree.levels()) {
    const bool bounded = std::isfinite(level.to_ratio);
    Json json;
    json["parts"] = level.parts;
    json["from_ratio"] = level.from_ratio;
    json["to_ratio"] = bounded ? Json(level.to_ratio) : Json(nullptr);
    json["stability"] = bounded ? Json(level.to_ratio / level.from_ratio) : Json(nullptr);
    levels.push_back(std::move(json));
  }
  return levels;
}

}  // namespace

std::string report_json(const Segmentation& segmentation, const SegmentOptions& options,
                        const std::string& source) {
  const Segmentation& s = segmentation;
  Json json;
  json["morsel"] = version();
  json["source"] = source;
  json["verdict"] = verdict_name(s.verdict);
  json["message"] = s.message;
  json["options"] = options_json(options, s);
  json["counts"] = counts_json(s);
  json["noise"] = {{"estimate", s.denoised.noise},
                   {"spacing", s.denoised.spacing},
                   {"smoothing_rounds", s.denoised.rounds}};
  json["ground"] = ground_json(s);
  json["volume"] = s.interior.volume;
  json["openings"] = openings_json(s.interior.openings);
  json["open_share"] = s.interior.open_share;
  json["bare_share"] = s.interior.bare_share;
  json["parts"] = Json::array();
  const std::size_t points = s.tree.piece_of_point.size() - s.ground.count_apart();
  for (std::size_t i = 0; i < s.parts.parts.size(); ++i) {
    json["parts"].push_back(part_json(s.parts.parts[i], static_cast<int>(i), s, points));
  }
  json["levels"] = s.verdict == Verdict::kSolid ? levels_json(s.tree) : Json::array();
  json["stages"] = Json::array();
  for (const StageCost& cost : s.costs) {
    json["stages"].push_back(
        {{"stage", cost.stage}, {"seconds", cost.seconds}, {"peak_bytes", cost.peak_bytes}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace morsel
