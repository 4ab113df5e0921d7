// morsel: the parts of a shape as stable manifolds of its distance function's maxima.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <morsel/delaunay.hpp>
#include <morsel/interior.hpp>
#include <morsel/vec3.hpp>
#include <optional>
#include <vector>

namespace morsel {

/// Stands for "no basin": cells that are not inner, points without an inside.
inline constexpr std::uint32_t kNoBasin = 0xffffffffU;

/// The inside cut into the stable manifolds (basins) of the maxima of the distance function.
struct Basins {
  std::vector<std::uint32_t> basin_of_cell;  ///< (c), kNoBasin where not inner
  std::vector<std::uint32_t> maximum;        ///< (b) the cell that holds each maximum; basins are
                                             ///< ordered by decreasing radius of the maximum
  std::size_t stray_cells = 0;  ///< inner cells from which no inner maximum is reached; they joined
                                ///< the basin beside them

  /// Number of basins.
  [[nodiscard]] std::size_t count() const { return maximum.size(); }
};

/// Follows the flow from each inner cell to its strongest reachable maximum: cell σ flows across a
/// facet into the neighbour on whose side σ's circumcentre lies (exact predicate).
/// Source: Dey, Giesen, Goswami 2004, section 3. Cost: O(c).
[[nodiscard]] Basins find_basins(const DelaunayComplex& complex, const Interior& interior,
                                 int threads = 0);

/// Volume and its first and second moments: what a part is, as far as sums can tell.
struct Moments {
  double volume = 0.0;             ///< in cubed units
  Vec3 first;                      ///< ∫ x dV
  std::array<double, 6> second{};  ///< ∫ x xᵀ dV about the origin: xx, xy, xz, yy, yz, zz

  /// Moments of the two together.
  Moments& operator+=(const Moments& other);
};

/// Where two pieces touch.
struct Neck {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  double radius = 0.0;  ///< largest circumradius over the shared facets
};

/// One step of joining pieces.
struct Merge {
  double ratio = 1.0;  ///< the smallest merge ratio at which the two sides become one part
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  /// False when one side holds too few of the points to be a part of its own; such a merge is
  /// always carried out.
  bool significant = false;
};

/// All cuts at once. Its leaves are pieces of the inside: the basins themselves with
/// Method::kPaper, regions of basins cut again where they are long or wide with Method::kDefault.
struct MergeTree {
  std::vector<Merge> merges;  ///< ascending in ratio; a spanning forest of the pieces
  std::vector<Neck> necks;    ///< all pairs of touching pieces, a < b, sorted
  std::vector<std::uint32_t> piece_of_point;  ///< (n) by input point; kNoBasin without inside
                                              ///< and for the ground
  std::vector<std::uint32_t> point_count;     ///< (p) points of each piece
  std::vector<Moments> moments;               ///< (p) about `origin`
  std::vector<Vec3> ball_center;              ///< (p) of the largest ball of a maximum or cell
  std::vector<double> ball_radius;            ///< (p)
  Vec3 origin;                                ///< reference point of the moments, for precision
  std::size_t component_count = 0;            ///< objects that do not touch
  double natural_ratio = 1.5;                 ///< where to cut when nothing else is asked for

  /// Numbers of parts that some cut gives, and the merge ratios between which it does.
  struct Level {
    std::size_t parts = 0;
    double from_ratio = 1.0;
    double to_ratio = 1.0;  ///< infinite for the coarsest
  };
  /// Coarsest first. Cost: O(p).
  [[nodiscard]] std::vector<Level> levels() const;
};

/// Joins the pieces of the inside, one by one, into one part an object.
///
/// Method::kPaper: single linkage of the basins over max(r1, r2) / r, r1 and r2 the radii of their
/// maxima and r the largest circumradius of a shared triangle.
/// Source: Dey, Giesen, Goswami 2004, section 3.3.
///
/// Method::kDefault: the flow's basins, grouped where sampling alone tells them apart, are cut into
/// pieces; the cheapest pair of touching groups is merged again and again. A pair costs the more,
/// the narrower its neck (the paper's ratio), the less of it is visible from one to the other
/// through the inside, and the larger both are; without a crease around the contact it costs
/// nothing. Ratios say in which order merges are best undone, on a scale like the paper's: the
/// costlier and the more points they divide, the larger. docs/method.md has the formulas.
/// Throws nothing but Error(kInternal). Cost: O(c log c).
[[nodiscard]] MergeTree build_merge_tree(const DelaunayComplex& complex,
                                         const VertexCells& vertex_cells,
                                         const std::vector<double>& lambda,
                                         const Interior& interior, const Basins& basins,
                                         Method method = Method::kDefault, int threads = 0);

/// How fine to cut; at most one of the two may be given.
struct CutOptions {
  std::optional<std::size_t> parts;   ///< this many parts, >= 1
  std::optional<double> merge_ratio;  ///< merge up to this ratio, >= 1

  /// Throws Error(kUsage) that names field, value and range.
  void check() const;
};

/// A part beside another.
struct PartNeighbor {
  int part = 0;
  double neck_radius = 0.0;  ///< of the largest ball through which the two are joined, in units

  friend bool operator==(const PartNeighbor&, const PartNeighbor&) = default;
};

/// One part of one cut.
struct Part {
  double volume = 0.0;                 ///< in cubed units; the paper's weight
  Vec3 center;                         ///< volume-weighted mean; the paper's representative point
  std::array<double, 6> covariance{};  ///< of the volume: xx, xy, xz, yy, yz, zz
  Vec3 ball_center;                    ///< of the largest inner ball among the part's maxima
  double ball_radius = 0.0;
  std::size_t point_count = 0;
  int object = 0;                       ///< objects do not touch; the one of most volume is 0
  std::vector<PartNeighbor> neighbors;  ///< ascending by part
};

/// One cut of the merge tree. Parts are numbered by decreasing volume.
struct Parts {
  std::vector<Part> parts;
  std::vector<int> part_of_piece;  ///< (p)
  std::vector<int> part_of_point;  ///< (n); -1 for the ground and when nothing is inside
  double merge_ratio = 1.0;        ///< at which the tree was cut
};

/// Cost: O(p + n); needs no geometry. Throws Error(kUsage).
[[nodiscard]] Parts cut(const MergeTree& tree, const CutOptions& options = {});

}  // namespace morsel
