// CGAL's triangulation is built, copied into flat arrays and freed here; no other file includes it.

#include <CGAL/tss.h>

namespace morsel {

// One for each thread, asked for by a call that is not repeated at every use, as compilers do it in
// a shared library.
template <typename Value>
[[gnu::noinline]] Value& of_this_thread() {
  static thread_local Value value;
  return value;
}

}  // namespace morsel

// The triangulation has one such table, which it looks into hundreds of times for each point.
#undef CGAL_STATIC_THREAD_LOCAL_VARIABLE_0
#define CGAL_STATIC_THREAD_LOCAL_VARIABLE_0(TYPE, VAR) TYPE& VAR = morsel::of_this_thread<TYPE>()

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <morsel/delaunay.hpp>
#include <string>
#include <utility>

#include "base/memory.hpp"
#include "base/spatial_order.hpp"
#include "base/threads.hpp"
#include "delaunay/balls.hpp"
#include "delaunay/insertion.hpp"

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

// A point needs so much at the peak, here and in the stages that follow.
constexpr std::size_t kBytesPerPoint = 1500;

// The slots of a cell such that its vertices ascend, the last two exchanged where that is needed to
// keep the cell positively oriented, as CGAL's cells are.
std::array<std::uint8_t, 4> canonical_slots(const Quad& vertices) {
  std::array<std::uint8_t, 4> slots{0, 1, 2, 3};
  bool odd = false;
  const auto exchange = [&](int i, int j) {
    std::swap(slots[i], slots[j]);
    odd = !odd;
  };
  for (int i = 1; i < 4; ++i) {
    for (int j = i; j > 0 && vertices[slots[j]] < vertices[slots[j - 1]]; --j) exchange(j, j - 1);
  }
  if (odd) exchange(2, 3);
  return slots;
}

Quad take(const Quad& values, const std::array<std::uint8_t, 4>& slots) {
  return {values[slots[0]], values[slots[1]], values[slots[2]], values[slots[3]]};
}

// Where each cell goes, so that they ascend by their vertices: a counting sort by the smallest,
// which comes first, small sorts inside.
std::vector<std::uint32_t> canonical_places(const std::vector<Quad>& vertices,
                                            std::size_t vertex_count, int threads) {
  std::vector<std::uint32_t> begins(vertex_count + 1, 0);
  in_turn(vertices.size(), [&](std::size_t c) { ++begins[vertices[c][0] + 1]; });
  for (std::size_t v = 0; v < vertex_count; ++v) begins[v + 1] += begins[v];
  std::vector<std::uint32_t> order(vertices.size());
  std::vector<std::uint32_t> ends(begins.begin(), begins.end() - 1);
  in_turn(vertices.size(),
          [&](std::size_t c) { order[ends[vertices[c][0]]++] = static_cast<std::uint32_t>(c); });
  std::vector<std::uint32_t> places(vertices.size());
  parallel_ranges(vertex_count, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<Quad, std::uint32_t>> group;
    for (std::size_t v = begin; v < end; ++v) {
      group.clear();
      for (std::uint32_t i = begins[v]; i < begins[v + 1]; ++i) {
        group.emplace_back(vertices[order[i]], order[i]);
      }
      std::sort(group.begin(), group.end());
      for (std::uint32_t i = begins[v]; const auto& entry : group) places[entry.second] = i++;
    }
  });
  return places;
}

// CGAL's cells lie scattered in memory: each is visited once, for its vertices and for its
// neighbours' numbers in CGAL's order.
template <typename Delaunay>
void copy_cells(const Delaunay& delaunay, DelaunayComplex& complex, int threads) {
  std::vector<typename Delaunay::Cell_handle> cells;
  cells.reserve(delaunay.tds().cells().size());
  const auto infinite = delaunay.infinite_vertex();
  std::size_t visited = 0;
  for (auto it = delaunay.all_cells_begin(); it != delaunay.all_cells_end(); ++it) {
    if (visited++ % 65536 == 0) check_cancelled();
    const bool finite = !it->has_vertex(infinite);
    it->info() = finite ? static_cast<std::uint32_t>(cells.size()) : kNoCell;
    if (finite) cells.push_back(it);
  }
  const auto each = [&](const auto& visit) {
    parallel_ranges(cells.size(), threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) visit(c);
    });
  };
  std::vector<Quad> vertices(cells.size());
  std::vector<Quad> neighbors(cells.size());
  each([&](std::size_t c) {
    for (int i = 0; i < 4; ++i) {
      vertices[c][i] = cells[c]->vertex(i)->info();
      neighbors[c][i] = cells[c]->neighbor(i)->info();
    }
    const auto slots = canonical_slots(vertices[c]);
    vertices[c] = take(vertices[c], slots);
    neighbors[c] = take(neighbors[c], slots);
  });
  const auto places = canonical_places(vertices, complex.vertices.size(), threads);
  complex.cells.resize(cells.size());
  complex.neighbors.resize(cells.size());
  each([&](std::size_t c) {
    complex.cells[places[c]] = vertices[c];
    for (std::uint32_t& d : neighbors[c]) d = d == kNoCell ? kNoCell : places[d];
    complex.neighbors[places[c]] = neighbors[c];
  });
}

template <typename Delaunay>
void insert_and_copy(Delaunay& delaunay, typename Delaunay::Lock_data_structure* locks,
                     DelaunayComplex& complex, int threads) {
  Insertion<Delaunay>(delaunay, complex.vertices, locks).run();
  complex.dimension = delaunay.dimension();
  if (complex.dimension == 3) copy_cells(delaunay, complex, threads);
}

void triangulate_parallel(DelaunayComplex& complex, int threads) {
  tbb::task_arena arena(threads);
  arena.execute([&, whose = CancelScope::current()] {
    const CancelScope scope(whose);
    CGAL::Bbox_3 box;
    for (const Vec3& v : complex.vertices) box += CGAL::Bbox_3(v.x, v.y, v.z, v.x, v.y, v.z);
    using Delaunay = Triangulation<CGAL::Parallel_tag>;
    Delaunay::Lock_data_structure locks(box, kLockGridSize);
    Delaunay delaunay;
    insert_and_copy(delaunay, &locks, complex, threads);
  });
}

}  // namespace

DelaunayComplex triangulate(std::span<const Vec3> points, const TriangulateOptions& options,
                            const Progress* progress) {
  const CancelScope scope(progress);
  DelaunayComplex complex;
  const int threads = resolve_threads(options.threads);
  SpatialOrder order = sort_spatially(points, threads);
  complex.vertices = std::move(order.points);
  complex.vertex_of_point = std::move(order.order_of_point);
  expect_memory(kBytesPerPoint * complex.vertices.size(), available_memory(),
                "triangulating " + std::to_string(complex.vertices.size()) + " points");
  if (threads > 1 && complex.vertices.size() >= kParallelThreshold) {
    triangulate_parallel(complex, threads);
  } else {
    Triangulation<CGAL::Sequential_tag> delaunay;
    insert_and_copy(delaunay, nullptr, complex, threads);
  }
  compute_balls(complex, threads);
  return complex;
}

}  // namespace morsel
