// morsel: finding a piece of a shape - one side of a scan, a limb, a fragment - in whole shapes.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <morsel/match.hpp>
#include <morsel/progress.hpp>
#include <morsel/search.hpp>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel {

/// A shape's surface as partial matching reads it: points with normals, and what surrounds a
/// hundred landmarks among them at six scales. It needs no inside: a piece has none.
class Surface {
 public:
  /// `points` (k, 3) in the unit of the input, spread evenly, such as a Sketch's; a few hundred to
  /// a few thousand. `parts` (k) is the part of each, -1 for none. The same for any order of the
  /// points. Cost: O(k · landmarks), some milliseconds for 2000.
  Surface(std::span<const Vec3> points, std::span<const int> parts);

  struct Data;
  /// For the functions below alone.
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;  // copies share it
};

/// How well the surroundings of the piece's landmarks recur among those of the whole, 0 … 1, higher
/// is better. It says which shapes are worth match_partial(); not symmetric.
/// Source for such surroundings: A. Johnson, M. Hebert, "Using Spin Images for Efficient Object
/// Recognition in Cluttered 3D Scenes", PAMI 1999. Differs: no sides are told apart, and normals
/// are counted along with places. Cost: below a millisecond.
[[nodiscard]] double recurrence(const Surface& whole, const Surface& piece,
                                const MatchOptions& options);

/// Lays a piece onto a whole shape and says how well it fits: only what the piece has counts, and
/// what the whole has beside it within the piece's convex hull counts against. The score is 0 … 1
/// and near 1 for a piece of that very shape; it does not compare with scores of other modes. Parts
/// are matched where most points of the source's part lie on the target's; `unmatched_target` are
/// those that the piece does not show.
/// `options.mode` is kPartial. The scale is found along, unless `options.same_scale`.
/// Source: pairs of points with normals as in S. Winkelmann et al., "Rapid Matching of Oriented
/// Points" (RANSAM), 2003; refinement: Y. Chen, G. Medioni, "Object Modelling by Registration of
/// Multiple Range Images", 1992. Cost: some tens of milliseconds. Thread-safe, deterministic.
[[nodiscard]] Match match_partial(const Surface& whole, const Surface& piece,
                                  const MatchOptions& options);

/// The `top` of `count` shapes that a piece fits best, best first, equal scores by index. All are
/// compared by recurrence(); the fifty that come out best, or twice `top` if that is more, by
/// match_partial(), whose scores these are. `whole(i)` makes shape i; it is called from several
/// threads. Cost: some milliseconds a shape. Throws Error(kUsage), Error(kCancelled).
[[nodiscard]] std::vector<Hit> search_partial(const Surface& piece, std::size_t count,
                                              const std::function<Surface(std::size_t)>& whole,
                                              std::size_t top, const MatchOptions& options,
                                              int threads = 0, const Progress* progress = nullptr);

}  // namespace morsel
