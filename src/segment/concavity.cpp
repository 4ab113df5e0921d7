#include "segment/concavity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/cancel.hpp"
#include "delaunay/balls.hpp"

namespace morsel {
namespace {

// The radii of the largest balls that touch a vertex; 0 where there is none.
struct LargestBalls {
  double inner = 0.0;
  double outer = 0.0;
};

std::vector<LargestBalls> find_largest_balls(const DelaunayComplex& complex,
                                             const Interior& interior) {
  std::vector<LargestBalls> largest(complex.vertices.size());
  in_turn(complex.cell_count(), [&](std::size_t c) {
    const bool is_inner = interior.side[c] == CellSide::kInner;
    for (std::size_t i = 0; i < 4; ++i) {
      LargestBalls& balls = largest[complex.cells[c][i]];
      double& held = is_inner ? balls.inner : balls.outer;
      held = std::max(held, complex.radii[c]);
      if (complex.neighbors[c][i] != kNoCell) continue;
      for (const int k : kFacetSlots[i]) {  // nothing bounds what lies beyond the hull
        largest[complex.cells[c][k]].outer = std::numeric_limits<double>::infinity();
      }
    }
  });
  return largest;
}

double concavity_of(const LargestBalls& balls) {
  if (!(balls.inner > 0.0)) return 0.0;
  return std::min(std::log1p(balls.inner / balls.outer), kMostConcave);  // also if none is outer
}

}  // namespace

double creased(double concavity) {
  constexpr double kDeep = 0.1;  // tuned (docs/benchmarks.md)
  const double depth = concavity / kDeep;
  return 1.0 - std::exp(-depth * depth);
}

std::vector<double> vertex_concavity(const DelaunayComplex& complex, const Interior& interior,
                                     const std::vector<double>& lambda) {
  // A crease is one for all samples near its bottom, a slit between two layers of a scan only for
  // those of the layer below.
  constexpr double kNear = 1.5;
  std::vector<double> own;
  own.reserve(complex.vertices.size());
  for (const LargestBalls& balls : find_largest_balls(complex, interior)) {
    own.push_back(concavity_of(balls));
  }
  std::vector<double> least(own);
  const auto lower = [&](std::uint32_t v, std::uint32_t by) {
    if (own[by] >= least[v]) return;  // most often
    const double apart = distance(complex.vertices[v], complex.vertices[by]);
    if (apart <= kNear * lambda[v]) least[v] = own[by];
  };
  in_turn(complex.cell_count(), [&](std::size_t c) {
    const auto& cell = complex.cells[c];
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) {
        lower(cell[i], cell[k]);
        lower(cell[k], cell[i]);
      }
    }
  });
  return least;
}

}  // namespace morsel
