// How deep in a concave crease each sample lies.
#pragma once

#include <morsel/delaunay.hpp>
#include <morsel/interior.hpp>
#include <vector>

namespace morsel {

/// (v) ln(1 + inner / outer) of the radii of the largest inner and the largest outer ball that
/// touch a vertex, at most kMostConcave, and of that the least among the vertex and its Delaunay
/// neighbours within 1.5 λ (`lambda`): 0 where the surface is convex (on the hull the outer ball is
/// unbounded) or no inner cell meets, ln 2 where the gap beyond is as wide as the shape is thick,
/// large at the bottom of a sharp crease. Needs no normals and does not change with scale.
/// Cost: O(c).
/// Source: the two balls are those at the poles of N. Amenta, M. Bern, "Surface Reconstruction by
/// Voronoi Filtering", Discrete & Computational Geometry 1999.
[[nodiscard]] std::vector<double> vertex_concavity(const DelaunayComplex& complex,
                                                   const Interior& interior,
                                                   const std::vector<double>& lambda);

/// How surely a sample of this concavity lies in a crease, from 0 to 1: 0.6 where the gap beyond is
/// ten times as wide as the shape is thick. What curves outwards or lies flat is in none.
[[nodiscard]] double creased(double concavity);

/// No vertex is more concave: sampling decides how small a ball fits into the bottom of a crease.
inline constexpr double kMostConcave = 3.0;

}  // namespace morsel
