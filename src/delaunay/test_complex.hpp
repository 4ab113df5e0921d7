// What the tests expect of a triangulation.
#pragma once

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <morsel/delaunay.hpp>

namespace morsel {

/// All cells are positively oriented, decided with rational numbers.
inline void expect_positive(const DelaunayComplex& complex) {
  using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  const auto corner = [&](std::uint32_t v) {
    const Vec3& p = complex.vertices[v];
    return Exact::Point_3(p.x, p.y, p.z);
  };
  for (const auto& [i, j, k, l] : complex.cells) {
    EXPECT_EQ(CGAL::orientation(corner(i), corner(j), corner(k), corner(l)), CGAL::POSITIVE);
  }
}

}  // namespace morsel
