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

// Cells in any order: vertices, ascending but for the orientation, and neighbours opposite them.
struct RawCells {
  std::vector<Quad> vertices;
  std::vector<Quad> neighbors;
};

// Brings a cell's vertices, and the neighbours opposite them, into ascending order, the last two
// swapped where that is needed to stay positively oriented, as CGAL's cells are.
void make_canonical(Quad& vertices, Quad& neighbors) {
  bool odd = false;
  const auto exchange = [&](int i, int j) {
    std::swap(vertices[i], vertices[j]);
    std::swap(neighbors[i], neighbors[j]);
    odd = !odd;
  };
  for (int i = 1; i < 4; ++i) {
    for (int j = i; j > 0 && vertices[j] < vertices[j - 1]; --j) exchange(j, j - 1);
  }
  if (odd) exchange(2, 3);
}

// CGAL's cells lie scattered in memory: one pass numbers those that are finite, all else goes by
// ranges of them.
template <typename Delaunay>
RawCells copy_cells(const Delaunay& delaunay, int threads) {
  std::vector<typename Delaunay::Cell_handle> cells;
  cells.reserve(delaunay.tds().cells().size());
  const auto infinite = delaunay.infinite_vertex();
  for (auto it = delaunay.all_cells_begin(); it != delaunay.all_cells_end(); ++it) {
    const bool finite = !it->has_vertex(infinite);
    it->info() = finite ? static_cast<std::uint32_t>(cells.size()) : kNoCell;
    if (finite) cells.push_back(it);
  }
  RawCells raw;
  raw.vertices.resize(cells.size());
  raw.neighbors.resize(cells.size());
  parallel_ranges(cells.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      for (int i = 0; i < 4; ++i) {
        raw.vertices[c][i] = cells[c]->vertex(i)->info();
        raw.neighbors[c][i] = cells[c]->neighbor(i)->info();
      }
      make_canonical(raw.vertices[c], raw.neighbors[c]);
    }
  });
  return raw;
}

// Canonical cells by their vertices: a counting sort by the smallest, which comes first, small
// sorts inside. Says which cell comes where.
std::vector<std::uint32_t> canonical_order(const std::vector<Quad>& vertices,
                                           std::size_t vertex_count, int threads) {
  std::vector<std::uint32_t> begins(vertex_count + 1, 0);
  for (const Quad& cell : vertices) ++begins[cell[0] + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) begins[v + 1] += begins[v];
  std::vector<std::uint32_t> order(vertices.size());
  std::vector<std::uint32_t> ends(begins.begin(), begins.end() - 1);
  for (std::uint32_t c = 0; c < vertices.size(); ++c) order[ends[vertices[c][0]]++] = c;
  parallel_ranges(vertex_count, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      std::sort(order.begin() + begins[v], order.begin() + begins[v + 1],
                [&](std::uint32_t a, std::uint32_t b) { return vertices[a] < vertices[b]; });
    }
  });
  return order;
}

void store_cells(const RawCells& raw, DelaunayComplex& complex, int threads) {
  const std::size_t count = raw.vertices.size();
  const std::vector<std::uint32_t> order =
      canonical_order(raw.vertices, complex.vertices.size(), threads);
  std::vector<std::uint32_t> place(count);
  for (std::uint32_t c = 0; c < count; ++c) place[order[c]] = c;
  complex.cells.resize(count);
  complex.neighbors.resize(count);
  parallel_ranges(count, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      complex.cells[c] = raw.vertices[order[c]];
      for (int i = 0; i < 4; ++i) {
        const std::uint32_t neighbor = raw.neighbors[order[c]][i];
        complex.neighbors[c][i] = neighbor == kNoCell ? kNoCell : place[neighbor];
      }
    }
  });
}

template <typename Delaunay>
void insert_and_copy(Delaunay& delaunay, DelaunayComplex& complex, int threads,
                     const Progress* progress) {
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> points;
  points.reserve(complex.vertices.size());
  for (const Vec3& v : complex.vertices) {
    points.emplace_back(Kernel::Point_3(v.x, v.y, v.z), static_cast<std::uint32_t>(points.size()));
  }
  delaunay.insert(points.begin(), points.end());
  if (progress != nullptr) progress->check();
  complex.dimension = delaunay.dimension();
  if (complex.dimension == 3) store_cells(copy_cells(delaunay, threads), complex, threads);
}

void triangulate_parallel(DelaunayComplex& complex, int threads, const Progress* progress) {
  tbb::task_arena arena(threads);
  arena.execute([&] {
    CGAL::Bbox_3 box;
    for (const Vec3& v : complex.vertices) box += CGAL::Bbox_3(v.x, v.y, v.z, v.x, v.y, v.z);
    Triangulation<CGAL::Parallel_tag>::Lock_data_structure locks(box, kLockGridSize);
    Triangulation<CGAL::Parallel_tag> delaunay(Kernel(), &locks);
    insert_and_copy(delaunay, complex, threads, progress);
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
    insert_and_copy(delaunay, complex, threads, progress);
  }
  compute_balls(complex, threads);
  return complex;
}

}  // namespace morsel
