// morsel: the plane that objects stand on, set apart before triangulating.
#pragma once

#include <cstddef>
#include <cstdint>
#include <morsel/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace morsel {

/// What to do with a plane under the objects.
enum class GroundMode : std::uint8_t {
  kAuto,    ///< set it apart where it is unmistakable
  kKeep,    ///< all points are of objects
  kRemove,  ///< set the plane apart that bears most points, however small or one-sided
};

/// "auto", "keep", "remove".
[[nodiscard]] std::string_view ground_mode_name(GroundMode mode);
/// The mode of that name, if there is one.
[[nodiscard]] std::optional<GroundMode> ground_mode_named(std::string_view name);

/// How to treat the ground.
struct GroundOptions {
  GroundMode mode = GroundMode::kAuto;
  int threads = 0;  ///< 0: all cores. The result does not depend on it.
};

/// A plane with its objects on one side.
struct GroundPlane {
  Vec3 normal;             ///< unit, towards the objects
  double offset = 0.0;     ///< of its points p: dot(normal, p), in units
  double thickness = 0.0;  ///< points up to this above the plane count as its own, in units

  /// Above the plane, in units; negative beneath.
  [[nodiscard]] double height(const Vec3& p) const { return dot(normal, p) - offset; }
};

/// The ground of a cloud, and what closes the objects where they stood on it.
struct Ground {
  std::optional<GroundPlane> plane;  ///< none: everything is of objects
  std::vector<char> apart;           ///< (n) 1 for points of the ground; empty without a plane
  std::vector<Vec3> base;            ///< points that the scan lacks under the objects

  /// Number of points of the ground. Cost: O(n).
  [[nodiscard]] std::size_t count_apart() const;
};

/// Looks for the plane that bears most points with nearly nothing beneath it. With kAuto it counts
/// only if it is a single sheet that reaches beyond all that stands on it on nearly all sides.
/// Points of the plane where an object stands stay with the object, as its base.
/// Source: M. Fischler, R. Bolles, "Random Sample Consensus", CACM 1981, for the first guess.
/// Throws Error(kInput) for a coordinate that is not finite. Cost: O(n log n), small beside a
/// triangulation; independent of the order of the points and of the number of threads.
[[nodiscard]] Ground find_ground(std::span<const Vec3> points, const GroundOptions& options = {});

}  // namespace morsel
