// What a match says, applied to points and parts, and as JSON.

#include <algorithm>
#include <cstddef>
#include <morsel/match.hpp>
#include <nlohmann/json.hpp>

namespace morsel {

std::vector<Vec3> on_target(const Match& match, std::span<const Vec3> points) {
  const std::array<double, 16>& m = match.target_from_source;
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (const Vec3& p : points) {
    const auto row = [&](std::size_t r) {
      return m[4 * r] * p.x + m[4 * r + 1] * p.y + m[4 * r + 2] * p.z + m[4 * r + 3];
    };
    result.push_back({row(0), row(1), row(2)});
  }
  return result;
}

std::vector<int> parts_on_target(const Match& match, std::span<const int> parts) {
  std::vector<int> result;
  result.reserve(parts.size());
  for (const int part : parts) {
    const auto at = std::find_if(match.matched.begin(), match.matched.end(),
                                 [&](const MatchedPart& pair) { return pair.source == part; });
    result.push_back(at == match.matched.end() ? -1 : at->target);
  }
  return result;
}

std::string to_json(const Match& match) {
  nlohmann::ordered_json json;
  json["score"] = match.score;
  json["mirrored"] = match.mirrored;
  json["target_from_source"] = match.target_from_source;
  json["matched"] = nlohmann::ordered_json::array();
  for (const MatchedPart& pair : match.matched) {
    json["matched"].push_back(
        {{"target", pair.target}, {"source", pair.source}, {"contribution", pair.contribution}});
  }
  json["unmatched_target"] = match.unmatched_target;
  json["unmatched_source"] = match.unmatched_source;
  return json.dump();
}

}  // namespace morsel
