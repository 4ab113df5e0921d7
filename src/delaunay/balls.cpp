#include "delaunay/balls.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/threads.hpp"

namespace morsel {
namespace {

struct Ball {
  Vec3 center;
  double radius;
};

Ball exact_ball(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  const auto exact = [](const Vec3& v) { return Exact::Point_3(v.x, v.y, v.z); };
  const Exact::Point_3 center = CGAL::circumcenter(exact(p), exact(q), exact(r), exact(s));
  const Vec3 rounded{CGAL::to_double(center.x()), CGAL::to_double(center.y()),
                     CGAL::to_double(center.z())};
  const double squared = CGAL::to_double(CGAL::squared_distance(center, exact(p)));
  return {rounded, std::sqrt(squared)};
}

// The centre relative to p solves 2 [u v w]^T x = (|u|^2, |v|^2, |w|^2).
Ball circumscribed_ball(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  const Vec3 u = q - p;
  const Vec3 v = r - p;
  const Vec3 w = s - p;
  const Vec3 vw = cross(v, w);
  const double det = dot(u, vw);
  const double size = std::sqrt(squared_norm(u) * squared_norm(v) * squared_norm(w));
  constexpr double kFlat = 1e-9;  // leaves six digits to the quotient below
  if (!(std::abs(det) > kFlat * size)) return exact_ball(p, q, r, s);
  const Vec3 numerator =
      squared_norm(u) * vw + squared_norm(v) * cross(w, u) + squared_norm(w) * cross(u, v);
  const Vec3 offset = (0.5 / det) * numerator;
  return {p + offset, norm(offset)};
}

}  // namespace

void compute_balls(DelaunayComplex& complex, int threads) {
  complex.centers.resize(complex.cells.size());
  complex.radii.resize(complex.cells.size());
  parallel_ranges(complex.cells.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const auto& [i, j, k, l] = complex.cells[c];
      const Ball ball = circumscribed_ball(complex.vertices[i], complex.vertices[j],
                                           complex.vertices[k], complex.vertices[l]);
      complex.centers[c] = ball.center;
      complex.radii[c] = ball.radius;
    }
  });
}

double circumradius(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double twice_area = norm(cross(b - a, c - a));
  if (twice_area == 0.0) return std::numeric_limits<double>::infinity();
  return distance(a, b) * distance(b, c) * distance(c, a) / (2.0 * twice_area);
}

// With p = a as origin, u, v the facet's edges, n = u x v and w = test: the centre of the smallest
// sphere is (|u|^2 v x n + |v|^2 n x u) / (2 |n|^2), and w is inside iff |w|^2 < 2 w . centre.
// Multiplied by |n|^2 this is a polynomial of degree 6. `bound` exceeds its rounding error: each
// term goes through fewer than 30 roundings, counting those of the three differences.
bool inside_equatorial_sphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& test) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = test - a;
  const Vec3 n = cross(u, v);
  const double uu = squared_norm(u);
  const double vv = squared_norm(v);
  const double ww = squared_norm(w);
  const double value = ww * squared_norm(n) - uu * dot(w, cross(v, n)) - vv * dot(w, cross(n, u));
  // |n| <= |u||v| and |w . (v x n)| <= |w||v||n|: the sum of the terms' absolute values is at most
  // a small multiple (the factor counts components) of this.
  const double magnitude =
      ww * uu * vv + 2.0 * uu * vv * std::sqrt(ww) * std::sqrt(std::max(uu, vv));
  const double bound = 512.0 * std::numeric_limits<double>::epsilon() * magnitude;
  // Below, products lose digits to underflow, which the bound does not count.
  constexpr double kLeastSquare = 1e-90;
  if (std::min({uu, vv, ww}) > kLeastSquare) {
    if (value < -bound) return true;
    if (value > bound) return false;
  }
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto point = [](const Vec3& p) { return Kernel::Point_3(p.x, p.y, p.z); };
  return CGAL::side_of_bounded_sphere(point(a), point(b), point(c), point(test)) ==
         CGAL::ON_BOUNDED_SIDE;
}

double cos_ball_angle(const DelaunayComplex& complex, std::size_t a, std::size_t b) {
  // From a shared vertex: the law of cosines over the two radii and the distance of the centres
  // loses all digits when one ball is huge. Seen from either cell it is the one that comes first.
  const auto& neighbors = complex.neighbors[a];
  const auto slot = std::ranges::find(neighbors, static_cast<std::uint32_t>(b)) - neighbors.begin();
  const Vec3& p = complex.vertices[complex.cells[a][slot == 0 ? 1 : 0]];
  const Vec3 to_a = complex.centers[a] - p;
  const Vec3 to_b = complex.centers[b] - p;
  const double lengths = std::sqrt(squared_norm(to_a) * squared_norm(to_b));
  return lengths > 0.0 ? std::clamp(dot(to_a, to_b) / lengths, -1.0, 1.0) : -1.0;
}

double cos_hull_angle(const DelaunayComplex& complex, std::size_t cell, int slot) {
  const Facet facet = facet_of(complex, cell, slot);
  const Vec3 normal = normal_of(facet);
  const double length = norm(normal) * complex.radii[cell];
  if (length == 0.0) return -1.0;
  return std::clamp(dot(normal, complex.centers[cell] - facet.a) / length, -1.0, 1.0);
}

}  // namespace morsel
