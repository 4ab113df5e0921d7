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

  [[nodiscard]] std::size_t count() const { return maximum.size(); }
};

/// Follows the flow from each inner cell to its strongest reachable maximum: cell σ flows across a
/// facet into the neighbour on whose side σ's circumcentre lies (exact predicate).
/// Source: Dey, Giesen, Goswami 2004, section 3. Cost: O(c).
[[nodiscard]] Basins find_basins(const DelaunayComplex& complex, const Interior& interior);

/// Volume and its first and second moments: what a part is, as far as sums can tell.
struct Moments {
  double volume = 0.0;              ///< in cubed units
  Vec3 first;                       ///< ∫ x dV
  std::array<double, 6> second{};   ///< ∫ x xᵀ dV about the origin: xx, xy, xz, yy, yz, zz

  Moments& operator+=(const Moments& other);
};

/// Where two basins touch.
struct Neck {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  double radius = 0.0;  ///< largest circumradius over the shared facets
};

/// One step of the single linkage of basins.
struct Merge {
  double ratio = 1.0;  ///< the smallest merge ratio at which the two sides become one part
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  /// False when one side holds too few of the points to be a part of its own; such a merge is
  /// always carried out.
  bool significant = false;
};

/// All cuts at once: the single linkage of the basins over their merge ratios.
struct MergeTree {
  std::vector<Merge> merges;  ///< ascending in ratio; a spanning forest of the basins
  std::vector<Neck> necks;    ///< all pairs of touching basins, a < b, sorted
  std::vector<std::uint32_t> basin_of_point;  ///< (n) by input point; kNoBasin without inside
  std::vector<std::uint32_t> point_count;     ///< (b) points of each basin
  std::vector<Moments> moments;               ///< (b) about `origin`
  std::vector<Vec3> ball_center;              ///< (b) of the maximum's ball
  std::vector<double> ball_radius;            ///< (b)
  Vec3 origin;                                ///< reference point of the moments, for precision
  std::size_t component_count = 0;            ///< objects that do not touch

  /// Numbers of parts that some cut gives, and the merge ratios between which it does.
  struct Level {
    std::size_t parts = 0;
    double from_ratio = 1.0;
    double to_ratio = 1.0;  ///< infinite for the coarsest
  };
  [[nodiscard]] std::vector<Level> levels() const;
};

struct MergeOptions {
  Method method = Method::kDefault;
};

[[nodiscard]] MergeTree build_merge_tree(const DelaunayComplex& complex,
                                         const VertexCells& vertex_cells,
                                         const std::vector<double>& lambda, const Basins& basins,
                                         const MergeOptions& options = {});

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
};

struct Part {
  double volume = 0.0;                  ///< in cubed units; the paper's weight
  Vec3 center;                          ///< volume-weighted mean; the paper's representative point
  std::array<double, 6> covariance{};   ///< of the volume: xx, xy, xz, yy, yz, zz
  Vec3 ball_center;                     ///< of the largest inner ball among the part's maxima
  double ball_radius = 0.0;
  std::size_t point_count = 0;
  std::vector<PartNeighbor> neighbors;  ///< ascending by part
};

/// One cut of the merge tree. Parts are numbered by decreasing volume.
struct Parts {
  std::vector<Part> parts;
  std::vector<int> part_of_basin;  ///< (b)
  std::vector<int> part_of_point;  ///< (n); -1 only when nothing is inside
  double merge_ratio = 1.0;        ///< at which the tree was cut
};

/// Cost: O(b + n); needs no geometry. Throws Error(kUsage).
[[nodiscard]] Parts cut(const MergeTree& tree, const CutOptions& options = {});

}  // namespace morsel
