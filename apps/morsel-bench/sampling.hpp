// morsel-bench: from a mesh to a cloud to be segmented, and from the cloud's labels back to faces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <morsel/io.hpp>
#include <morsel/vec3.hpp>
#include <span>
#include <vector>

namespace morsel::bench {

struct CloudOptions {
  std::size_t points = 20000;  ///< on the surface
  double noise = 0.0;          ///< standard deviation as a fraction of the bounding-box diagonal
  double outliers = 0.0;       ///< as a fraction of `points`, uniform in the box grown by half
  double hole = 0.0;       ///< radius of a ball around a sample that takes those in it away, as a
                           ///< fraction of the bounding-box diagonal
  std::uint64_t seed = 1;  ///< of the whole run

  /// Throws Error(kUsage).
  void check() const;
};

/// The samples of a mesh, then the outliers.
struct Cloud {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> triangle;  ///< of the samples alone

  [[nodiscard]] std::size_t sample_count() const { return triangle.size(); }
};

/// Models of one run get unrelated seeds, each the same in every run.
[[nodiscard]] std::uint64_t seed_of_model(std::uint64_t seed, int id);

/// Uniform in the points' bounding box grown by half about its middle.
[[nodiscard]] std::vector<Vec3> outliers_around(std::span<const Vec3> points, std::size_t count,
                                                std::uint64_t seed);

[[nodiscard]] Cloud sample_cloud(const TriangleMesh& mesh, int id, const CloudOptions& options);

/// Where the samples of `from` lie on `to`, the same triangles in another posture.
[[nodiscard]] std::vector<Vec3> carried_over(const Cloud& cloud, const TriangleMesh& from,
                                             const TriangleMesh& to);

/// The label of each face: that of most of its samples, the smallest such; a face without samples
/// takes that of the sample nearest to its centroid. `labels` are those of the cloud's points.
[[nodiscard]] std::vector<int> face_labels(const TriangleMesh& mesh, const Cloud& cloud,
                                           std::span<const int> labels);

}  // namespace morsel::bench
