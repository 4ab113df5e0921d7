// Figures 1 and 2: the steps of the method in the plane, and a saddle.
#include <fmt/format.h>

#include <algorithm>
#include <morsel/error.hpp>

#include "plane/drawing.hpp"
#include "sections.hpp"

namespace morsel::reproduce {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kPoints = 700;
constexpr double kNoise = 0.012;
constexpr std::size_t kSaddlePoints = 300;
constexpr double kSaddleNoise = 0.008;

// A beast seen from its side.
const std::vector<plane::Sausage>& beast() {
  static const std::vector<plane::Sausage> beast{
      {{-1.0, 0.0}, {0.9, 0.05}, 0.52},                                       // body
      {{1.0, 0.2}, {1.55, 0.95}, 0.2},                                        // neck
      {{1.6, 1.05}, {2.0, 0.9}, 0.3},                                         // head
      {{0.95, -0.2}, {1.05, -1.3}, 0.17},                                     // legs
      {{-1.0, -0.2}, {-1.15, -1.3}, 0.17}, {{-1.4, 0.1}, {-2.2, 0.6}, 0.13},  // tail
  };
  return beast;
}

// Two disks that overlap: two maxima, and what lies between them.
ordered_json saddle_json(const Study& study, const plane::Rules& rules) {
  const std::vector<plane::Sausage> disks{{{-0.85, 0.0}, {-0.85, 0.0}, 1.0},
                                          {{0.8, 0.1}, {0.8, 0.1}, 0.8}};
  const plane::Shape shape =
      plane::find_parts(plane::sample_outline(disks, kSaddlePoints, kSaddleNoise, 1), rules);
  const auto saddle = plane::clearest_saddle(shape);
  if (!saddle) throw Error(ErrorCode::kInternal, "two disks in the plane have no saddle");
  const auto& [a, b] = saddle->maxima;
  const plane::Point& one = shape.points[saddle->ends[0]];
  const plane::Point& other = shape.points[saddle->ends[1]];
  return {{"picture", study.keep("plane-saddle", plane::draw_saddle(shape, *saddle))},
          {"points", shape.points.size()},
          {"noise", kSaddleNoise},
          {"radius", 0.5 * plane::distance(one, other)},
          {"maxima", {shape.triangles[a].radius, shape.triangles[b].radius}}};
}

}  // namespace

void add_plane(Study& study) {
  const plane::Rules rules;
  const plane::Shape shape =
      plane::find_parts(plane::sample_outline(beast(), kPoints, kNoise, 1), rules);
  ordered_json json = {{"points", shape.points.size()},
                       {"noise", kNoise},
                       {"rho", rules.big_ball_ratio},
                       {"deep_angle", rules.deep_angle},
                       {"merge_ratio", rules.merge_ratio},
                       {"triangles", shape.triangles.size()},
                       {"small_balls", std::ranges::count(shape.big, false)},
                       {"inner", std::ranges::count(shape.inner, true)},
                       {"maxima", shape.maxima.size()},
                       {"parts", shape.part_count}};
  std::size_t number = 0;
  for (const std::string& svg : plane::draw_steps(shape)) {
    json["steps"].push_back(study.keep(fmt::format("plane-{}", ++number), svg));
  }
  json["saddle"] = saddle_json(study, rules);
  study.figures["plane"] = std::move(json);
}

}  // namespace morsel::reproduce
