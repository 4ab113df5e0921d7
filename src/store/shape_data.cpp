// From a segmentation to what is stored of it.

#include <fmt/format.h>

#include <cstring>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <string_view>
#include <utility>

#include "store/hash.hpp"

namespace morsel {
namespace {

std::string options_text(const SegmentOptions& options) {
  const InteriorOptions& interior = options.interior;
  std::string text = interior.method == Method::kPaper
                         ? fmt::format("method paper, big_ball_ratio {}, deep_angle {}",
                                       interior.big_ball_ratio, interior.deep_angle)
                         : "method default";
  if (interior.method != Method::kPaper && options.denoise.rounds) {
    text += fmt::format(", denoise {}", *options.denoise.rounds);
  }
  if (interior.method != Method::kPaper && options.ground.mode != GroundMode::kAuto) {
    text += fmt::format(", ground {}", ground_mode_name(options.ground.mode));
  }
  if (options.cut.parts) text += fmt::format(", parts {}", *options.cut.parts);
  if (options.cut.merge_ratio) text += fmt::format(", merge_ratio {}", *options.cut.merge_ratio);
  return fmt::format("morsel {}, {}", version(), text);
}

}  // namespace

std::string content_key(std::span<const Vec3> points, const SegmentOptions& options) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  store::Fingerprint fingerprint;
  const std::string_view bytes(reinterpret_cast<const char*>(points.data()), points.size_bytes());
  return fingerprint.add(options_text(options)).add(bytes).hex_128();
}

ShapeData make_shape_data(const Segmentation& segmentation, const SegmentOptions& options,
                          std::string content) {
  ShapeData data;
  data.signature = make_signature(segmentation, options.threads);
  if (!(data.signature.size > 0.0)) throw Error(ErrorCode::kInput, segmentation.message);
  data.content = std::move(content);
  data.options = options_text(options);
  data.points = segmentation.labels.size();
  data.sketch = make_sketch(segmentation);
  return data;
}

}  // namespace morsel
