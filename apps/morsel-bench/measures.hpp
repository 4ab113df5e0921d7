// morsel-bench: how far two segmentations of a mesh are apart.
//
// Source: X. Chen, A. Golovinskiy, T. Funkhouser, "A Benchmark for 3D Mesh Segmentation",
// SIGGRAPH 2009, section 3; Rand index: W. M. Rand, JASA 66, 1971.
// Differs: every face counts the same whatever its area; distances of cuts are Euclidean and not
// along the surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <morsel/io.hpp>
#include <morsel/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace morsel::bench {

/// All measures are errors: 0 for equal segmentations.
enum Measure : std::size_t {
  kRand,               ///< 1 - Rand index over pairs of faces
  kCutDiscrepancy,     ///< mean distance between the cuts, both ways added, over the mean radius
  kHamming,            ///< mean of the two rates below
  kMissingRate,        ///< faces of people's parts outside the computed part that fits best
  kFalseAlarmRate,     ///< faces of computed parts outside the person's part that fits best
  kGlobalConsistency,  ///< GCE: 0 also when one segmentation refines the other
  kLocalConsistency,   ///< LCE: 0 also when the refinement differs from place to place
  kMeasureCount
};
inline constexpr std::array<std::string_view, kMeasureCount> kMeasureNames = {"rand",
                                                                              "cut_discrepancy",
                                                                              "hamming",
                                                                              "missing_rate",
                                                                              "false_alarm_rate",
                                                                              "consistency_global",
                                                                              "consistency_local"};

/// Not given where a measure is not defined (a cut discrepancy to a segmentation without cuts).
using Scores = std::array<std::optional<double>, kMeasureCount>;

/// How many faces have which pair of labels.
struct Contingency {
  struct Cell {
    std::size_t row = 0;
    std::size_t column = 0;
    std::uint64_t count = 0;
  };
  std::vector<Cell> cells;             ///< the pairs that occur
  std::vector<std::uint64_t> rows;     ///< faces of each part of the first segmentation
  std::vector<std::uint64_t> columns;  ///< faces of each part of the second one
  std::uint64_t total = 0;
};

/// Labels may be any integers; each different one is a part. As many labels in `a` as in `b`.
[[nodiscard]] Contingency count_pairs(std::span<const int> a, std::span<const int> b);

/// 1 - Rand index, exact in integers up to the division.
[[nodiscard]] double rand_error(const Contingency& table);

/// The share of faces that lie outside the row part that overlaps their column part most.
[[nodiscard]] double missing_rate(const Contingency& table);
/// The same with rows and columns exchanged.
[[nodiscard]] double false_alarm_rate(const Contingency& table);

[[nodiscard]] double global_consistency_error(const Contingency& table);
[[nodiscard]] double local_consistency_error(const Contingency& table);

/// What the cuts of a mesh can be made of.
struct MeshEdges {
  struct Edge {
    Vec3 midpoint;
    double length = 0.0;
    std::array<std::uint32_t, 2> faces{};
  };
  std::vector<Edge> edges;   ///< between two faces; one for each two faces in turn around it
  double mean_radius = 0.0;  ///< mean distance of the surface to its centroid
};
[[nodiscard]] MeshEdges find_edges(const TriangleMesh& mesh);

/// The edges between faces of different labels.
struct Cuts {
  std::vector<Vec3> midpoints;
  std::vector<double> lengths;
};
[[nodiscard]] Cuts find_cuts(const MeshEdges& edges, std::span<const int> labels);

/// Mean distance, by length, from the midpoints of each one's edges to the nearest midpoint of the
/// other's, both directions added, over `mean_radius`. Not defined when only one has cuts.
[[nodiscard]] std::optional<double> cut_discrepancy(const Cuts& a, const Cuts& b,
                                                    double mean_radius);

/// All measures of `labels` against each of `people`, each averaged over the people for whom it is
/// defined.
[[nodiscard]] Scores compare_with_people(const TriangleMesh& mesh, std::span<const int> labels,
                                         std::span<const std::vector<int>> people);

/// Averages each measure over the scores that have it.
[[nodiscard]] Scores mean_scores(std::span<const Scores> scores);

/// How many different labels there are.
[[nodiscard]] std::size_t count_labels(std::span<const int> labels);

}  // namespace morsel::bench
