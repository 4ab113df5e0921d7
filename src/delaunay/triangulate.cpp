// CGAL's triangulation is built, copied into flat arrays and freed here; no other file includes it.

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <iterator>
#include <morsel/delaunay.hpp>
#include <utility>

#include "base/spatial_order.hpp"
#include "base/threads.hpp"
#include "delaunay/balls.hpp"

namespace morsel {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<std::uint32_t, Kernel,
                                              CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
template <typename Concurrency>
using Triangulation = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase, Concurrency>>;

using Quad = std::array<std::uint32_t, 4>;

// Below this size CGAL's locks cost more than a second thread brings.
constexpr std::size_t kParallelThreshold = 50000;
constexpr int kLockGridSize = 50;

// The cell's vertices ascending, the last two swapped where that is needed to stay positively
// oriented, as CGAL's cells are. `slots` says which CGAL slot each came from.
template <typename CellHandle>
Quad canonical_vertices(const CellHandle& cell, std::array<int, 4>* slots) {
  std::array<std::pair<std::uint32_t, int>, 4> sorted;
  for (int i = 0; i < 4; ++i) sorted[i] = {cell->vertex(i)->info(), i};
  bool odd = false;
  for (int i = 1; i < 4; ++i) {
    for (int j = i; j > 0 && sorted[j].first < sorted[j - 1].first; --j) {
      std::swap(sorted[j], sorted[j - 1]);
      odd = !odd;
    }
  }
  if (odd) std::swap(sorted[2], sorted[3]);
  if (slots != nullptr) {
    for (int i = 0; i < 4; ++i) (*slots)[i] = sorted[i].second;
  }
  return {sorted[0].first, sorted[1].first, sorted[2].first, sorted[3].first};
}

// Finite cells by their smallest vertices: a counting sort by the smallest, small sorts inside.
template <typename Cell>
std::vector<Cell> canonical_order(const std::vector<Cell>& cells, std::size_t vertex_count) {
  std::vector<std::uint32_t> begins(vertex_count + 1, 0);
  const auto smallest = [](const Cell& cell) {
    return std::min({cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(),
                     cell->vertex(3)->info()});
  };
  for (const Cell& cell : cells) ++begins[smallest(cell) + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) begins[v + 1] += begins[v];
  std::vector<Cell> ordered(cells.size());
  std::vector<std::uint32_t> ends(begins.begin(), begins.end() - 1);
  for (const Cell& cell : cells) ordered[ends[smallest(cell)]++] = cell;
  std::vector<std::pair<Quad, Cell>> bucket;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    bucket.clear();
    for (std::uint32_t i = begins[v]; i < begins[v + 1]; ++i) {
      bucket.emplace_back(canonical_vertices(ordered[i], nullptr), ordered[i]);
    }
    std::sort(bucket.begin(), bucket.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < bucket.size(); ++i) ordered[begins[v] + i] = bucket[i].second;
  }
  return ordered;
}

template <typename Delaunay>
void copy_cells(const Delaunay& delaunay, DelaunayComplex& complex) {
  using Cell = typename Delaunay::Cell_handle;
  std::vector<Cell> cells;
  cells.reserve(delaunay.tds().cells().size());
  for (auto it = delaunay.all_cells_begin(); it != delaunay.all_cells_end(); ++it) {
    if (delaunay.is_infinite(it)) {
      it->info() = kNoCell;
    } else {
      cells.push_back(it);
    }
  }
  cells = canonical_order(cells, complex.vertices.size());
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c]->info() = static_cast<std::uint32_t>(c);
  complex.cells.resize(cells.size());
  complex.neighbors.resize(cells.size());
  std::array<int, 4> slots{};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    complex.cells[c] = canonical_vertices(cells[c], &slots);
    for (int i = 0; i < 4; ++i) complex.neighbors[c][i] = cells[c]->neighbor(slots[i])->info();
  }
}

template <typename Delaunay>
void insert_and_copy(Delaunay& delaunay, DelaunayComplex& complex, const Progress* progress) {
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> points;
  points.reserve(complex.vertices.size());
  for (const Vec3& v : complex.vertices) {
    points.emplace_back(Kernel::Point_3(v.x, v.y, v.z), static_cast<std::uint32_t>(points.size()));
  }
  delaunay.insert(points.begin(), points.end());
  if (progress != nullptr) progress->check();
  complex.dimension = delaunay.dimension();
  if (complex.dimension == 3) copy_cells(delaunay, complex);
}

void triangulate_parallel(DelaunayComplex& complex, int threads, const Progress* progress) {
  tbb::task_arena arena(threads);
  arena.execute([&] {
    CGAL::Bbox_3 box;
    for (const Vec3& v : complex.vertices) box += CGAL::Bbox_3(v.x, v.y, v.z, v.x, v.y, v.z);
    Triangulation<CGAL::Parallel_tag>::Lock_data_structure locks(box, kLockGridSize);
    Triangulation<CGAL::Parallel_tag> delaunay(Kernel(), &locks);
    insert_and_copy(delaunay, complex, progress);
  });
}

}  // namespace

DelaunayComplex triangulate(std::span<const Vec3> points, const TriangulateOptions& options,
                            const Progress* progress) {
  DelaunayComplex complex;
  SpatialOrder order = sort_spatially(points);
  complex.vertices = std::move(order.points);
  complex.vertex_of_point = std::move(order.order_of_point);
  const int threads = resolve_threads(options.threads);
  if (threads > 1 && complex.vertices.size() >= kParallelThreshold) {
    triangulate_parallel(complex, threads, progress);
  } else {
    Triangulation<CGAL::Sequential_tag> delaunay;
    insert_and_copy(delaunay, complex, progress);
  }
  compute_balls(complex, threads);
  return complex;
}

}  // namespace morsel
