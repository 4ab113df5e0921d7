// morsel: what is kept of a shape to find its like: at most one kilobyte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <morsel/delaunay.hpp>
#include <morsel/segment.hpp>
#include <morsel/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace morsel {

/// Most bytes that encode() returns.
inline constexpr std::size_t kMostSignatureBytes = 1024;
/// Most parts that a signature keeps; the heaviest ones.
inline constexpr std::size_t kMostSignatureParts = 12;

/// One of the paper's weighted points and what else is kept of the part. Lengths in RMS radii of
/// the shape, positions relative to its centroid, in the shape's own orientation.
struct SignaturePart {
  double weight = 0.0;                 ///< share of the shape's volume, 0 … 1
  Vec3 center;                         ///< representative point
  std::array<double, 6> covariance{};  ///< of the volume: xx, xy, xz, yy, yz, zz
  double ball_radius = 0.0;            ///< of the largest inner ball
  std::vector<PartNeighbor>
      neighbors;  ///< ascending by part; parts that were not kept are left out

  friend bool operator==(const SignaturePart&, const SignaturePart&) = default;
};

/// A plain value. Everything in it is rounded as encode() stores it, so that a signature does not
/// change when it is written and read.
struct Signature {
  Vec3 centroid;      ///< of the volume (of the points when nothing is inside), in the input's unit
  double size = 0.0;  ///< RMS radius about the centroid in the input's unit; 0: nothing to compare
  std::vector<SignaturePart> parts;  ///< by decreasing volume; index = part of the segmentation
  std::vector<std::uint8_t> tables;  ///< statistics that no rotation, mirroring or scaling changes,
                                     ///< one byte a value; docs/signature.md

  friend bool operator==(const Signature&, const Signature&) = default;
};

/// Describes a shape. Rotating, moving, scaling or mirroring the input changes the tables by
/// rounding alone and turns the parts along. A cloud without an inside has no parts and the
/// tables of its points only; one that is flat has an empty signature (size 0).
/// Cost: O(c log c), a fifth of the triangulation. Thread-safe.
[[nodiscard]] Signature make_signature(const DelaunayComplex& complex, const Basins& basins,
                                       const Parts& parts, int threads = 0);

/// At most kMostSignatureBytes: version, little-endian numbers, checksum; docs/signature.md has the
/// layout. The same bytes on every machine.
[[nodiscard]] std::vector<std::byte> encode(const Signature& signature);
/// Reads what encode() wrote. `name` stands for the source in messages.
/// Throws Error(kInput) that says what is wrong: length, version, checksum or the value.
[[nodiscard]] Signature decode(std::span<const std::byte> bytes, const std::string& name = {});

/// The same content as JSON text; docs/signature.md has the schema.
[[nodiscard]] std::string to_json(const Signature& signature);
/// Throws Error(kInput) that names the field.
[[nodiscard]] Signature signature_from_json(const std::string& text, const std::string& name = {});

}  // namespace morsel
