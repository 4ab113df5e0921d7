// morsel: parts of solid shapes from noisy point clouds. The whole way in one call.
#pragma once

#include <cstddef>
#include <morsel/color.hpp>
#include <morsel/d2.hpp>
#include <morsel/delaunay.hpp>
#include <morsel/denoise.hpp>
#include <morsel/error.hpp>
#include <morsel/ground.hpp>
#include <morsel/html.hpp>
#include <morsel/interior.hpp>
#include <morsel/io.hpp>
#include <morsel/match.hpp>
#include <morsel/picture.hpp>
#include <morsel/progress.hpp>
#include <morsel/search.hpp>
#include <morsel/segment.hpp>
#include <morsel/signature.hpp>
#include <morsel/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace morsel {

/// The library's version, "major.minor.patch".
[[nodiscard]] std::string version();

/// What a user may choose; the defaults serve every shape.
struct SegmentOptions {
  InteriorOptions interior;  ///< holds the method, the paper's or the default, of all stages
  DenoiseOptions denoise;    ///< not used by Method::kPaper, which takes the points as they are
  GroundOptions ground;      ///< likewise
  CutOptions cut;
  int threads = 0;  ///< 0: all cores. The result does not depend on it.

  /// Throws Error(kUsage) that names field, value and range.
  void check() const;
};

/// What the cloud turned out to be.
enum class Verdict {
  kSolid,         ///< one or more solids; there are parts
  kTooFewPoints,  ///< fewer than four distinct points
  kFlat,          ///< all points on one plane or line
  kNotSolid,      ///< no inside was found: an open sheet, or noise that fills its walls
};

/// What one stage cost.
struct StageCost {
  std::string stage;
  double seconds = 0.0;
  std::size_t peak_bytes = 0;  ///< of the process, at the end of the stage
};

/// Everything that segment() found, stage by stage.
struct Segmentation {
  Verdict verdict = Verdict::kTooFewPoints;
  std::string message;      ///< one sentence: what was found and, unless solid, what to do
  std::vector<int> labels;  ///< (n) part of each input point, in input order; -1 for the
                            ///< ground and unless solid
  Parts parts;
  MergeTree tree;  ///< cut() it again for other labels: Parts::part_of_point
  Ground ground;
  Denoised denoised;
  DelaunayComplex complex;
  Interior interior;
  Basins basins;
  std::vector<StageCost> costs;
};

/// find_ground → denoise → triangulate → find_interior → find_basins → build_merge_tree → cut.
/// Geometric outcomes are in `verdict`; throws Error(kUsage), Error(kInput) for a coordinate that
/// is not finite, Error(kCancelled). Cost: O(n log n), about 1 kB a point. Safe to call from
/// several threads.
[[nodiscard]] Segmentation segment(std::span<const Vec3> points, const SegmentOptions& options = {},
                                   const Progress* progress = nullptr);

/// The signature of what segment() found: encode() it, match() it with others. Of size 0 for a flat
/// cloud.
[[nodiscard]] inline Signature make_signature(const Segmentation& segmentation, int threads = 0) {
  return make_signature(segmentation.complex, segmentation.basins, segmentation.parts, threads);
}

/// The same cloud cut otherwise: parts, labels and message as segment() gives them with `cut`, the
/// rest as it was. What bounds no solid stays as it is. Cost: O(p + n). Throws Error(kUsage).
[[nodiscard]] Segmentation recut(Segmentation segmentation, const CutOptions& cut);

/// The report as JSON text: version, options, counts of every stage, parts, merge levels, costs.
/// Its schema is docs/report.md. `source` names the input.
[[nodiscard]] std::string report_json(const Segmentation& segmentation,
                                      const SegmentOptions& options, const std::string& source);

}  // namespace morsel
