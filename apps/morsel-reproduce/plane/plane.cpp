#include "plane/plane.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <morsel/error.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/random.hpp"
#include "base/union_find.hpp"

namespace morsel::plane {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<std::uint32_t, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel,
                                   CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }
double length(const Point& a) { return std::hypot(a.x, a.y); }

std::vector<Triangle> triangulate(const std::vector<Point>& points) {
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> input;
  for (const Point& p : points) {
    input.emplace_back(Kernel::Point_2(p.x, p.y), static_cast<std::uint32_t>(input.size()));
  }
  Delaunay delaunay(input.begin(), input.end());
  for (auto face : delaunay.all_face_handles()) face->info() = kNone;
  std::uint32_t count = 0;
  for (auto face : delaunay.finite_face_handles()) face->info() = count++;
  std::vector<Triangle> triangles(count);
  for (auto face : delaunay.finite_face_handles()) {
    Triangle& t = triangles[face->info()];
    for (int i = 0; i < 3; ++i) {
      t.corners[static_cast<std::size_t>(i)] = face->vertex(i)->info();
      t.neighbors[static_cast<std::size_t>(i)] = face->neighbor(i)->info();
    }
    const auto center = delaunay.circumcenter(face);
    t.center = {center.x(), center.y()};
    t.radius = distance(t.center, points[t.corners[0]]);
  }
  return triangles;
}

// λ of the paper: the mean distance to the three nearest points.
std::vector<double> nearest_distances(const std::vector<Point>& points) {
  constexpr std::size_t kNearest = 3;
  const std::size_t kept = std::min(kNearest + 1, points.size());  // the point itself is one
  std::vector<double> result;
  for (const Point& p : points) {
    std::vector<double> distances;
    for (const Point& q : points) distances.push_back(distance(p, q));
    const auto end = distances.begin() + static_cast<std::ptrdiff_t>(kept);
    std::partial_sort(distances.begin(), end, distances.end());
    result.push_back(std::accumulate(distances.begin(), end, 0.0) / static_cast<double>(kept - 1));
  }
  return result;
}

// The corners of the edge opposite corner i, in the triangle's direction.
std::array<std::uint32_t, 2> edge_of(const Triangle& t, std::size_t i) {
  return {t.corners[(i + 1) % 3], t.corners[(i + 2) % 3]};
}

// Which ball lies beyond an edge: the direction from one of its ends to that ball's centre.
Point toward_beyond(const Shape& shape, const Triangle& t, std::size_t i) {
  const auto [from, to] = edge_of(t, i);
  if (t.neighbors[i] != kNone) return shape.triangles[t.neighbors[i]].center - shape.points[from];
  const Point along = shape.points[to] - shape.points[from];
  return {along.y, -along.x};  // a half-plane: straight out
}

bool meet_deeply(const Shape& shape, const Triangle& t, std::size_t i, double least_cosine) {
  const Point here = t.center - shape.points[edge_of(t, i)[0]];
  const Point beyond = toward_beyond(shape, t, i);
  return dot(here, beyond) > least_cosine * length(here) * length(beyond);
}

// Section 2: the walk from beyond the hull through big balls that meet deeply.
void find_inside(Shape& shape, const Rules& rules) {
  const std::vector<double> lambda = nearest_distances(shape.points);
  for (const Triangle& t : shape.triangles) {
    shape.big.push_back(std::ranges::any_of(
        t.corners, [&](std::uint32_t c) { return t.radius > rules.big_ball_ratio * lambda[c]; }));
  }
  const double least = std::cos(rules.deep_angle * std::numbers::pi / 180.0);
  std::vector<std::uint32_t> stack;
  std::vector<bool> outer(shape.triangles.size(), false);
  const auto visit = [&](std::uint32_t triangle) {
    if (outer[triangle] || !shape.big[triangle]) return;
    outer[triangle] = true;
    stack.push_back(triangle);
  };
  for (std::uint32_t i = 0; i < shape.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& t = shape.triangles[i];
      if (t.neighbors[k] == kNone && meet_deeply(shape, t, k, least)) visit(i);
    }
  }
  while (!stack.empty()) {
    const Triangle& t = shape.triangles[stack.back()];
    stack.pop_back();
    for (std::size_t k = 0; k < 3; ++k) {
      if (t.neighbors[k] != kNone && meet_deeply(shape, t, k, least)) visit(t.neighbors[k]);
    }
  }
  for (std::size_t i = 0; i < outer.size(); ++i) shape.inner.push_back(shape.big[i] && !outer[i]);
}

// Across the edge on whose far side the centre lies: the one whose opposite angle is obtuse.
std::uint32_t flow_of(const Shape& shape, std::uint32_t triangle) {
  const Triangle& t = shape.triangles[triangle];
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& corner = shape.points[t.corners[i]];
    const auto [a, b] = edge_of(t, i);
    if (dot(shape.points[a] - corner, shape.points[b] - corner) < 0.0) return t.neighbors[i];
  }
  return triangle;
}

// Section 3: from each triangle along the flow to a maximum.
void find_basins(Shape& shape) {
  const auto count = static_cast<std::uint32_t>(shape.triangles.size());
  std::vector<std::uint32_t> next(count);
  for (std::uint32_t i = 0; i < count; ++i) next[i] = flow_of(shape, i);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (shape.inner[i] && next[i] == i) shape.maxima.push_back(i);
    shape.flow.push_back(next[i] == i ? kNone : next[i]);
  }
  std::ranges::stable_sort(shape.maxima, std::ranges::greater{},
                           [&](std::uint32_t t) { return shape.triangles[t].radius; });
  std::vector<std::uint32_t> number(count, kNone);
  for (std::uint32_t i = 0; i < shape.maxima.size(); ++i) number[shape.maxima[i]] = i;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint32_t at = i;
    while (at != kNone && shape.inner[at] && next[at] != at) at = next[at];
    const bool ends_inside = at != kNone && shape.inner[at];
    shape.basin.push_back(ends_inside ? number[at] : kNone);
  }
}

double half_edge(const Shape& shape, const Triangle& t, std::size_t i) {
  const auto [a, b] = edge_of(t, i);
  return 0.5 * distance(shape.points[a], shape.points[b]);
}

// Section 3.3: basins whose maxima are hardly larger than the edge between them.
void merge_basins(Shape& shape, double ratio) {
  UnionFind parts(shape.maxima.size());
  for (std::uint32_t i = 0; i < shape.triangles.size(); ++i) {
    const Triangle& t = shape.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t j = t.neighbors[k];
      if (j == kNone || shape.basin[i] == kNone || shape.basin[j] == kNone) continue;
      const double largest = std::max(shape.triangles[shape.maxima[shape.basin[i]]].radius,
                                      shape.triangles[shape.maxima[shape.basin[j]]].radius);
      if (largest <= ratio * half_edge(shape, t, k)) parts.join(shape.basin[i], shape.basin[j]);
    }
  }
  std::vector<int> name(shape.maxima.size(), -1);
  for (std::uint32_t i = 0; i < shape.maxima.size(); ++i) {
    int& part = name[parts.root(i)];
    if (part < 0) part = shape.part_count++;
    shape.part.push_back(part);
  }
}

std::vector<std::uint32_t> way_up(const Shape& shape, std::uint32_t from) {
  std::vector<std::uint32_t> way{from};
  while (shape.flow[way.back()] != kNone) way.push_back(shape.flow[way.back()]);
  return way;
}

// No other point in the disk over the edge: neither triangle flows across it.
bool is_saddle(const Shape& shape, std::uint32_t i, std::uint32_t j) {
  return shape.flow[i] != j && shape.flow[j] != i;
}

// Along the outline: one side, the end b, the other side, the end a.
Point on_outline(const Sausage& s, Random& random) {
  const Point axis = s.b - s.a;
  const double side = length(axis);
  const double arc = std::numbers::pi * s.radius;
  double at = 2.0 * (side + arc) * random.uniform();
  const double turn = at < side + arc ? 1.0 : -1.0;
  if (turn < 0.0) at -= side + arc;
  const Point along =
      side > 0.0 ? Point{turn * axis.x / side, turn * axis.y / side} : Point{turn, 0};
  const Point across{-along.y, along.x};
  const Point& begin = turn > 0.0 ? s.a : s.b;
  const Point& end = turn > 0.0 ? s.b : s.a;
  if (at < side) {
    return {begin.x + at * along.x + s.radius * across.x,
            begin.y + at * along.y + s.radius * across.y};
  }
  const double angle = (at - side) / s.radius;
  const double u = s.radius * std::sin(angle);
  const double v = s.radius * std::cos(angle);
  return {end.x + u * along.x + v * across.x, end.y + u * along.y + v * across.y};
}

bool covers(const Sausage& s, const Point& p) {
  const Point axis = s.b - s.a;
  const double squared = dot(axis, axis);
  const double t = squared > 0.0 ? std::clamp(dot(p - s.a, axis) / squared, 0.0, 1.0) : 0.0;
  return distance(p, {s.a.x + t * axis.x, s.a.y + t * axis.y}) < s.radius * (1.0 - 1e-9);
}

}  // namespace

double distance(const Point& a, const Point& b) { return length(a - b); }

Shape find_parts(std::vector<Point> points, const Rules& rules) {
  if (points.size() < 3) {
    throw Error(ErrorCode::kUsage,
                fmt::format("{} points in the plane; expected three or more", points.size()));
  }
  Shape shape;
  shape.points = std::move(points);
  shape.triangles = triangulate(shape.points);
  find_inside(shape, rules);
  find_basins(shape);
  merge_basins(shape, rules.merge_ratio);
  return shape;
}

std::optional<Saddle> clearest_saddle(const Shape& shape) {
  std::optional<Saddle> best;
  double largest = 0.0;
  for (std::uint32_t i = 0; i < shape.triangles.size(); ++i) {
    const Triangle& t = shape.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t j = t.neighbors[k];
      if (j == kNone || j < i || shape.basin[i] == kNone || shape.basin[j] == kNone) continue;
      const std::uint32_t a = shape.maxima[shape.basin[i]];
      const std::uint32_t b = shape.maxima[shape.basin[j]];
      if (a == b || !is_saddle(shape, i, j)) continue;
      const double smaller = std::min(shape.triangles[a].radius, shape.triangles[b].radius);
      const double ratio = smaller / half_edge(shape, t, k);
      if (ratio <= largest) continue;
      largest = ratio;
      best = Saddle{
          .ends = edge_of(t, k), .maxima = {a, b}, .ways = {way_up(shape, i), way_up(shape, j)}};
    }
  }
  return best;
}

std::vector<Point> sample_outline(std::span<const Sausage> sausages, std::size_t count,
                                  double noise, std::uint64_t seed) {
  Random random(seed);
  const auto outline = [](const Sausage& s) {
    return 2.0 * (distance(s.a, s.b) + std::numbers::pi * s.radius);
  };
  double total = 0.0;
  for (const Sausage& s : sausages) total += outline(s);
  std::vector<Point> points;
  while (points.size() < count) {
    double rest = random.uniform() * total;
    std::size_t chosen = 0;
    while (chosen + 1 < sausages.size() && rest >= outline(sausages[chosen])) {
      rest -= outline(sausages[chosen]);
      ++chosen;
    }
    const Point p = on_outline(sausages[chosen], random);
    if (std::ranges::any_of(sausages, [&](const Sausage& s) { return covers(s, p); })) continue;
    const double dx = noise * random.normal();
    points.push_back({p.x + dx, p.y + noise * random.normal()});
  }
  return points;
}

}  // namespace morsel::plane
