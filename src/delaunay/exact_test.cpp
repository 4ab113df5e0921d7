// Small degenerate clouds at many scales: the cells, and the decisions of the flow, are those of
// exact numbers throughout.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <morsel/delaunay.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "base/test_shapes.hpp"
#include "delaunay/balls.hpp"
#include "delaunay/test_complex.hpp"

namespace morsel {
namespace {

using shapes::Points;
using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
using Cells = std::set<std::array<std::uint32_t, 4>>;  // of ascending vertices

Exact::Point_3 exact(const Vec3& p) { return {p.x, p.y, p.z}; }

Vec3 whole(Random& random, int most) {
  const auto one = [&] {
    return static_cast<double>(random.below(2U * static_cast<unsigned>(most) + 1)) - most;
  };
  const double x = one();
  const double y = one();
  return {x, y, one()};
}

Points some(const Points& all, Random& random, std::size_t count) {
  Points points;
  while (points.size() < count) points.push_back(all[random.below(all.size())]);
  return points;
}

// All points of whole coordinates at one distance from the origin.
Points cospherical(int squared_radius) {
  Points points;
  const int most = static_cast<int>(std::sqrt(squared_radius)) + 1;
  for (int x = -most; x <= most; ++x) {
    for (int y = -most; y <= most; ++y) {
      for (int z = -most; z <= most; ++z) {
        if (x * x + y * y + z * z == squared_radius) {
          points.push_back(
              {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        }
      }
    }
  }
  return points;
}

// Some bits away, as far as there are bits.
Vec3 beside(Vec3 p, Random& random) {
  double& x = random.below(2) == 0 ? p.x : p.z;
  x += (x == 0.0 ? 1.0 : x) * (random.below(2) == 0 ? 0x1p-52 : -0x1p-50);
  return p;
}

enum class Kind {
  kGrid,
  kFewBits,
  kCospherical,
  kCoplanar,
  kAlmostCoplanar,
  kNearDuplicates,
  kLines
};
constexpr std::array kKinds{Kind::kGrid,     Kind::kFewBits,        Kind::kCospherical,
                            Kind::kCoplanar, Kind::kAlmostCoplanar, Kind::kNearDuplicates,
                            Kind::kLines};

Points cloud(Kind kind, Random& random) {
  constexpr std::size_t kCount = 24;
  Points points;
  const auto add = [&](const auto& make) {
    while (points.size() < kCount) points.push_back(make());
  };
  switch (kind) {
    case Kind::kGrid:
      return shapes::grid(3);
    case Kind::kFewBits:
      add([&] { return whole(random, 3); });
      break;
    case Kind::kCospherical:
      points = some(cospherical(random.below(2) == 0 ? 9 : 54), random, kCount);
      points.push_back(whole(random, 1));
      break;
    case Kind::kCoplanar:
    case Kind::kAlmostCoplanar:
      add([&] {
        const Vec3 p = whole(random, 5);
        return Vec3{p.x, p.y, p.x + 2.0 * p.y};
      });
      if (kind == Kind::kAlmostCoplanar) points[0] = beside(points[0], random);
      break;
    case Kind::kNearDuplicates:
      while (points.size() < kCount) {
        points.push_back(0.1 * whole(random, 9));
        points.push_back(beside(points.back(), random));
      }
      break;
    case Kind::kLines:
      add([&] {
        const Vec3 p = whole(random, 9);
        return random.below(2) == 0 ? Vec3{p.x, 0.0, 0.0} : Vec3{1.0, p.y, 1.0};
      });
      break;
  }
  return points;
}

// A power of two keeps the degeneracy, another factor rounds it away to the last bit.
double scale(Random& random) {
  const int exponent = static_cast<int>(random.below(600)) - 300;
  return std::ldexp(random.below(3) == 0 ? 0.1 : 1.0, exponent);
}

std::pair<Cells, int> exact_cells(const Points& distinct) {
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Exact>;
  using Data =
      CGAL::Triangulation_data_structure_3<Vertex, CGAL::Delaunay_triangulation_cell_base_3<Exact>>;
  std::vector<std::pair<Exact::Point_3, std::uint32_t>> points;
  for (std::uint32_t i = 0; i < distinct.size(); ++i) points.emplace_back(exact(distinct[i]), i);
  const CGAL::Delaunay_triangulation_3<Exact, Data> delaunay(points.begin(), points.end());
  Cells cells;
  if (delaunay.dimension() == 3) {
    for (const auto cell : delaunay.finite_cell_handles()) {
      std::array<std::uint32_t, 4> corners{};
      for (int i = 0; i < 4; ++i) corners[static_cast<std::size_t>(i)] = cell->vertex(i)->info();
      std::ranges::sort(corners);
      cells.insert(corners);
    }
  }
  return {cells, delaunay.dimension()};
}

Cells cells_of(const DelaunayComplex& complex) {
  Cells cells;
  for (std::array<std::uint32_t, 4> corners : complex.cells) {
    std::ranges::sort(corners);
    cells.insert(corners);
  }
  return cells;
}

// Of each facet of each cell, and the vertex opposite.
void expect_exact_flow(const DelaunayComplex& complex) {
  for (const auto& cell : complex.cells) {
    for (std::size_t slot = 0; slot < 4; ++slot) {
      const auto corner = [&](std::size_t k) -> const Vec3& {
        return complex.vertices[cell[static_cast<std::size_t>(kFacetSlots[slot][k])]];
      };
      const Vec3& test = complex.vertices[cell[slot]];
      const auto side = CGAL::side_of_bounded_sphere(exact(corner(0)), exact(corner(1)),
                                                     exact(corner(2)), exact(test));
      ASSERT_EQ(inside_equatorial_sphere(corner(0), corner(1), corner(2), test),
                side == CGAL::ON_BOUNDED_SIDE);
    }
  }
}

class ExactTest : public ::testing::TestWithParam<int> {};

TEST_P(ExactTest, DegenerateCloudsHaveTheCellsOfExactNumbers) {
  Random random(static_cast<std::uint64_t>(GetParam()));
  for (const Kind kind : kKinds) {
    const Points base = cloud(kind, random);
    const double factor = scale(random);
    const Points points = shapes::scaled(base, factor);
    SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)) + ", scale " +
                 std::to_string(std::ilogb(factor)));
    const DelaunayComplex complex = triangulate(points, {.threads = 1});
    const auto [cells, dimension] = exact_cells(complex.vertices);
    ASSERT_EQ(complex.dimension, dimension);
    ASSERT_EQ(cells_of(complex), cells);
    ASSERT_EQ(complex.cell_count(), cells.size());
    expect_positive(complex);
    expect_exact_flow(complex);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ExactTest, ::testing::Range(1, 31));

}  // namespace
}  // namespace morsel
