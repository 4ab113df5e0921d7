// morsel: point clouds and meshes in, labelled points out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <morsel/vec3.hpp>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace morsel {

/// One scalar column that came with the points (a PLY property such as `red` or `intensity`), kept
/// in its own type so that a PLY output can repeat it unchanged.
struct PointProperty {
  std::string name;
  std::variant<std::vector<std::int8_t>, std::vector<std::uint8_t>, std::vector<std::int16_t>,
               std::vector<std::uint16_t>, std::vector<std::int32_t>, std::vector<std::uint32_t>,
               std::vector<float>, std::vector<double>>
      values;
};

/// Points (n, 3) in the unit and order of the input; every property has n values.
struct PointCloud {
  std::vector<Vec3> points;
  std::vector<PointProperty> properties;
};

/// A triangle soup: vertices (v, 3), triangles (t, 3) of vertex indices; polygons are fanned.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// How a mesh becomes a point cloud.
struct SampleOptions {
  std::size_t count = 20000;  ///< points, 1 … 2^31
  double noise = 0.0;         ///< standard deviation, isotropic Gaussian, as a fraction of the
                              ///< bounding-box diagonal of the mesh, 0 … 1
  std::uint64_t seed = 1;     ///< of the portable generator

  /// Throws Error(kUsage) that names field, value and range.
  void check() const;
};

/// Points sampled from a mesh and the triangle that each came from.
struct SurfaceSample {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> triangle;
};

/// True when `path` holds triangles or polygons (OFF, OBJ, STL, PLY with faces, glTF/GLB) rather
/// than bare points. Decided by reading the whole file, not by its name, so a pipe is used up;
/// false for `-`. Throws Error(kInput).
[[nodiscard]] bool is_mesh_file(const std::filesystem::path& path);

/// Reads the points of a point-cloud file: PLY, PCD, XYZ/TXT/PTS/CSV, OFF, OBJ, NPY, LAS 1.2-1.4.
/// The content decides on the format, the extension only where the content leaves it open. A file
/// with faces is sampled as `sample` says. `-` reads standard input, as XYZ text unless the content
/// is unmistakably another format. Coordinates keep every bit of the file's numbers. No allocation
/// exceeds a small multiple of the file's size (glTF may place a mesh many times: 20 million
/// vertices). Thread-safe.
/// Throws Error(kInput) with the file, the line, byte or point (from 0) and what would be right;
/// Error(kUsage) for `sample` out of range; Error(kResource) when memory runs out.
[[nodiscard]] PointCloud read_points(const std::filesystem::path& path,
                                     const SampleOptions& sample = {});

/// As read_points() from the bytes of a file called `name`, which is in no folder: a glTF that
/// needs another file is refused. Nothing on the disk is read. For bytes of strangers.
[[nodiscard]] PointCloud parse_points(std::string bytes, const std::string& name,
                                      const SampleOptions& sample = {});

/// Reads XYZ text (comments, one header line, extra columns, any of space, tab, comma, semicolon
/// as separator) from a stream; `name` stands for the file in messages. A header that names x, y
/// and z says in which columns they are. Throws Error(kInput).
[[nodiscard]] PointCloud read_xyz(std::istream& stream, const std::string& name);

/// Reads a mesh: OFF, OBJ, STL, PLY, glTF/GLB (nodes' transforms applied). Throws Error(kInput),
/// also when the file holds no face.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path);

/// Area-weighted random samples of the surface. The same mesh, options and seed give the same
/// points on every machine. Throws Error(kInput) when the mesh has no area.
[[nodiscard]] SurfaceSample sample_surface(const TriangleMesh& mesh, const SampleOptions& options);

/// The mesh's signed volume by the divergence theorem, in cubed units; meaningful when closed.
[[nodiscard]] double signed_volume(const TriangleMesh& mesh);

/// One integer a line, in input order; the file is replaced atomically or not at all.
/// Throws Error(kOutput).
void write_labels(const std::filesystem::path& path, std::span<const int> labels);

/// Points with a `part` property and the part's colour, by extension: .ply (keeps the input's
/// properties), .pcd, .xyz, .npz. Atomic. Throws Error(kUsage) for another extension,
/// Error(kOutput).
void write_points(const std::filesystem::path& path, const PointCloud& cloud,
                  std::span<const int> labels);

}  // namespace morsel
