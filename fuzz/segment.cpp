// Small clouds on a grid: as degenerate as they come, at any scale.

#include <cmath>
#include <cstdint>
#include <morsel/morsel.hpp>
#include <tuple>
#include <vector>

#include "targets.hpp"

namespace morsel::fuzz {
namespace {

// The first byte is the scale, the others coordinates: few bits make many points cospherical.
std::vector<Vec3> points_of(std::string_view bytes) {
  if (bytes.empty()) return {};
  constexpr std::size_t kMost = 300;
  const int exponent = 2 * static_cast<std::int8_t>(bytes[0]);
  std::vector<Vec3> points;
  for (std::size_t i = 1; i + 2 < bytes.size() && points.size() < kMost; i += 3) {
    const auto at = [&](std::size_t k) { return std::ldexp(bytes[i + k], exponent); };
    points.push_back({at(0), at(1), at(2)});
  }
  return points;
}

}  // namespace

void run_segment(std::string_view /*name*/, std::string bytes) {
  const std::vector<Vec3> points = points_of(bytes);
  for (const Method method : {Method::kDefault, Method::kPaper}) {
    SegmentOptions options;
    options.interior.method = method;
    options.threads = 1;
    accepts([&] {
      const Segmentation result = segment(points, options);
      require(result.labels.size() == points.size(), "a point has a label");
      const auto parts = static_cast<int>(result.parts.parts.size());
      for (const int label : result.labels) require(label < parts, "a label is a part");
      std::ignore = report_json(result, options, "fuzz");
      const Signature signature = make_signature(result, 1);
      require(decode(encode(signature)) == signature, "a signature is rounded");
    });
  }
}

}  // namespace morsel::fuzz
