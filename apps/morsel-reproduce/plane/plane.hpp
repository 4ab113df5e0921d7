// The rules of the paper in the plane, where they can be drawn: from noisy points around a closed
// curve to the parts of what it encloses.
//
// Source: T. K. Dey, J. Giesen, S. Goswami, "Shape Segmentation and Matching from Noisy Point
// Clouds", SPBG 2004, sections 2 and 3, one dimension lower.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace morsel::plane {

struct Point {
  double x = 0.0;
  double y = 0.0;

  friend bool operator==(const Point&, const Point&) = default;
};

[[nodiscard]] double distance(const Point& a, const Point& b);

/// Stands for "no triangle".
inline constexpr std::uint32_t kNone = 0xffffffffU;

/// A Delaunay triangle and its ball.
struct Triangle {
  std::array<std::uint32_t, 3> corners{};    ///< counterclockwise
  std::array<std::uint32_t, 3> neighbors{};  ///< opposite each corner; kNone beyond the hull
  Point center;
  double radius = 0.0;
};

struct Rules {
  double big_ball_ratio = 2.0;  ///< ρ: a ball is big when its radius exceeds ρ·λ of any corner
  double deep_angle = 60.0;  ///< balls meet deeply below this angle between their centres, degrees
  double merge_ratio = 1.5;
};

/// Every step of the way.
struct Shape {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<bool> big;              ///< (t)
  std::vector<bool> inner;            ///< (t) big and not reached by the walk from beyond the hull
  std::vector<std::uint32_t> flow;    ///< (t) where a triangle flows; kNone: nowhere
  std::vector<std::uint32_t> basin;   ///< (t) index into `maxima`; kNone where not inner
  std::vector<std::uint32_t> maxima;  ///< inner triangles that hold one, largest radius first
  std::vector<int> part;              ///< (basins) numbered by their largest maximum
  int part_count = 0;
};

/// Throws Error(kUsage) for fewer than three points. Inner triangles whose flow leaves the inside
/// have no basin. Cost: O(n²).
[[nodiscard]] Shape find_parts(std::vector<Point> points, const Rules& rules);

/// The middle of a Delaunay edge whose own disk holds no other point: a saddle of the distance to
/// the points. The edge is its stable manifold; on either side the flow runs to a maximum.
struct Saddle {
  std::array<std::uint32_t, 2> ends{};               ///< points
  std::array<std::uint32_t, 2> maxima{};             ///< triangles, of different basins
  std::array<std::vector<std::uint32_t>, 2> ways{};  ///< triangles from the edge to each maximum
};

/// The one that separates two maxima most: of the largest ratio of the smaller maximum's radius to
/// half the edge's length. None when there are not two basins that touch.
[[nodiscard]] std::optional<Saddle> clearest_saddle(const Shape& shape);

/// All points within `radius` of a segment.
struct Sausage {
  Point a;
  Point b;
  double radius = 1.0;
};

/// `count` points uniform on the outline of the union, each moved by Gaussian noise.
[[nodiscard]] std::vector<Point> sample_outline(std::span<const Sausage> sausages,
                                                std::size_t count, double noise,
                                                std::uint64_t seed);

}  // namespace morsel::plane
