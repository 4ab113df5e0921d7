// The stages up to the basins, for the tests of this folder.
#pragma once

#include <morsel/morsel.hpp>
#include <vector>

#include "base/test_shapes.hpp"

namespace morsel::shapes {

struct Stages {
  DelaunayComplex complex;
  VertexCells vertex_cells;
  std::vector<double> lambda;
  Interior interior;
  Basins basins;

  [[nodiscard]] MergeTree tree(Method method) const {
    return build_merge_tree(complex, vertex_cells, lambda, interior, basins, method);
  }
};

inline Stages run_stages(const Points& points) {
  Stages s;
  s.complex = triangulate(points);
  s.vertex_cells = find_vertex_cells(s.complex);
  s.lambda = mean_neighbor_distance(s.complex);
  s.interior = find_interior(s.complex, s.vertex_cells, s.lambda);
  s.basins = find_basins(s.complex, s.interior);
  return s;
}

}  // namespace morsel::shapes
