// morsel: how alike two shapes are, and how to lay one onto the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <morsel/interior.hpp>
#include <morsel/signature.hpp>
#include <morsel/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace morsel {

/// What counts as the same shape.
enum class MatchMode : std::uint8_t {
  kRigid,        ///< turned, moved, scaled and, if allowed, mirrored
  kArticulated,  ///< also bent at its joints: only what bending keeps, or nearly keeps, is compared
  kPartial,      ///< a piece of it, turned, moved and scaled; partial.hpp has the functions
};

/// "rigid", "articulated", "partial".
[[nodiscard]] std::string_view mode_name(MatchMode mode);
/// The mode of that name, if there is one.
[[nodiscard]] std::optional<MatchMode> mode_named(std::string_view name);

/// How two shapes are compared.
struct MatchOptions {
  Method method = Method::kDefault;  ///< the paper's score over weighted points, or the default one
  bool mirror = true;                ///< a shape and its mirror image count as the same
  MatchMode mode = MatchMode::kRigid;
  bool same_scale = false;  ///< in partial mode: both are in the same unit and keep their size

  /// Throws Error(kUsage) for the paper's method in other modes than rigid: it knows nothing of
  /// bending or pieces; and for `same_scale` in other modes than partial.
  void check() const;
};

/// Two parts that lie on each other in the alignment, or beside each other in articulated mode.
struct MatchedPart {
  int target = 0;  ///< part of the target
  int source = 0;  ///< part of the source
  double contribution =
      0.0;  ///< share of the aligned volumes' overlap that the pair makes up, 0 … 1
};

/// How the source lies on the target.
struct Match {
  double score = 0.0;  ///< 0 … 1; 1 for equal signatures
  /// Row-major 4×4, in the input units of both shapes: rotation (and reflection when `mirrored`),
  /// scale and translation.
  std::array<double, 16> target_from_source{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  bool mirrored = false;
  /// By decreasing contribution. Rigid: each part at most once. Articulated: each part at least
  /// once, more often where the other shape's posture cuts it into several.
  std::vector<MatchedPart> matched;
  std::vector<int> unmatched_target;  ///< parts without a counterpart, ascending
  std::vector<int> unmatched_source;
};

/// Scores and aligns two shapes. Thread-safe, deterministic. Like all that compares signatures, it
/// throws Error(kUsage) in partial mode: a signature is of the whole shape; match_partial() lays
/// points onto points.
/// Method::kPaper: heaviest parts onto each other, then the best of the alignments of one other
/// part with another. Source: Dey, Giesen, Goswami 2004, section 4. Differs: docs/signature.md.
[[nodiscard]] Match match(const Signature& target, const Signature& source,
                          const MatchOptions& options = {});

/// The score alone, the same as match().score. Symmetric: exchanging the two gives the same bits.
[[nodiscard]] double match_score(const Signature& a, const Signature& b,
                                 const MatchOptions& options = {});

/// One of the measures that the default score is made of.
struct ScoreTerm {
  std::string name;       ///< "shells", "facing", "pairs", "thickness", "centricity"
  double distance = 0.0;  ///< 0: equal; 1: as different as two unrelated shapes are on average
  double weight = 0.0;  ///< 0 … 1, sums to 1; smaller for measures of an inside that is not there
};

/// Why two shapes score as they do: with Method::kDefault and mirroring allowed match_score() is
/// exp(-Σ weight · distance). Empty when either has no size. Thread-safe; docs/signature.md says
/// what each measure is.
[[nodiscard]] std::vector<ScoreTerm> explain_score(const Signature& a, const Signature& b,
                                                   MatchMode mode = MatchMode::kRigid);

/// The source's points, (n, 3) in its unit, where they lie on the target, in its unit.
[[nodiscard]] std::vector<Vec3> on_target(const Match& match, std::span<const Vec3> points);

/// For each part of the source, -1 for none, the part of the target that it lies on; -1 where there
/// is no such part.
[[nodiscard]] std::vector<int> parts_on_target(const Match& match, std::span<const int> parts);

/// As JSON text: score, mirrored, target_from_source, matched, unmatched_target, unmatched_source.
[[nodiscard]] std::string to_json(const Match& match);

}  // namespace morsel
