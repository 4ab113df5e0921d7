#include "interior/poles.hpp"

#include "delaunay/balls.hpp"

namespace morsel {

std::vector<Vec3> hull_normals(const DelaunayComplex& complex) {
  std::vector<Vec3> normals(complex.vertices.size());
  for (std::uint32_t c = 0; c < complex.cell_count(); ++c) {
    for (int i = 0; i < 4; ++i) {
      if (complex.neighbors[c][i] != kNoCell) continue;
      const Vec3 normal = normal_of(facet_of(complex, c, i));
      for (const int slot : kFacetSlots[i]) {
        Vec3& sum = normals[complex.cells[c][slot]];
        sum = sum + normal;
      }
    }
  }
  return normals;
}

}  // namespace morsel
