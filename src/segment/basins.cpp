// Source: T. K. Dey, J. Giesen, S. Goswami, "Shape Segmentation and Matching from Noisy Point
// Clouds", SPBG 2004, sections 3.1 and 3.2.

#include <algorithm>
#include <morsel/segment.hpp>

#include "base/threads.hpp"
#include "delaunay/balls.hpp"

namespace morsel {
namespace {

// Bit i is set when the cell flows across its facet i into an inner neighbour.
std::vector<std::uint8_t> find_flow(const DelaunayComplex& complex, const Interior& interior,
                                    int threads) {
  std::vector<std::uint8_t> flow(complex.cell_count(), 0);
  const auto set_flow = [&](std::size_t c) {
    const auto& cell = complex.cells[c];
    for (int i = 0; i < 4; ++i) {
      const Facet facet = facet_of(complex, c, i);
      if (inside_equatorial_sphere(facet.a, facet.b, facet.c, complex.vertices[cell[i]])) {
        flow[c] |= static_cast<std::uint8_t>(1U << i);
      }
    }
  };
  parallel_ranges(flow.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      if (interior.side[c] == CellSide::kInner) set_flow(c);
    }
  });
  return flow;
}

int slot_of_neighbor(const DelaunayComplex& complex, std::uint32_t cell, std::uint32_t neighbor) {
  const auto& neighbors = complex.neighbors[cell];
  return static_cast<int>(std::ranges::find(neighbors, neighbor) - neighbors.begin());
}

// Inner cells whose circumcentre they hold, largest ball first, equal ones by index.
std::vector<std::uint32_t> find_maxima(const DelaunayComplex& complex, const Interior& interior,
                                       const std::vector<std::uint8_t>& flow) {
  std::vector<std::uint32_t> maxima;
  for (std::uint32_t c = 0; c < flow.size(); ++c) {
    if (interior.side[c] == CellSide::kInner && flow[c] == 0) maxima.push_back(c);
  }
  std::ranges::stable_sort(maxima, [&](std::uint32_t a, std::uint32_t b) {
    return complex.radii[a] > complex.radii[b];
  });
  return maxima;
}

// Collects against the flow every inner cell that is not collected yet.
void collect(const DelaunayComplex& complex, const std::vector<std::uint8_t>& flow,
             const Interior& interior, std::uint32_t basin, std::uint32_t maximum,
             std::vector<std::uint32_t>& basin_of_cell) {
  std::vector<std::uint32_t> stack{maximum};
  basin_of_cell[maximum] = basin;
  while (!stack.empty()) {
    const std::uint32_t c = stack.back();
    stack.pop_back();
    for (const std::uint32_t d : complex.neighbors[c]) {
      if (d == kNoCell || basin_of_cell[d] != kNoBasin || interior.side[d] != CellSide::kInner) {
        continue;
      }
      if ((flow[d] >> slot_of_neighbor(complex, d, c) & 1U) == 0) continue;
      basin_of_cell[d] = basin;
      stack.push_back(d);
    }
  }
}

// Cells that flow out of the inside without meeting a maximum: each joins the basin across its
// largest ball neighbour, in rounds from the collected cells outwards; a group of stray cells that
// touches no basin becomes one around its largest ball.
void adopt_strays(const DelaunayComplex& complex, const Interior& interior, Basins& basins) {
  std::vector<std::uint32_t> strays;
  for (std::uint32_t c = 0; c < basins.basin_of_cell.size(); ++c) {
    if (interior.side[c] == CellSide::kInner && basins.basin_of_cell[c] == kNoBasin) {
      strays.push_back(c);
    }
  }
  basins.stray_cells = strays.size();
  std::ranges::stable_sort(strays, [&](std::uint32_t a, std::uint32_t b) {
    return complex.radii[a] > complex.radii[b];
  });
  while (!strays.empty()) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> adopted;
    std::vector<std::uint32_t> rest;
    for (const std::uint32_t c : strays) {
      std::uint32_t best = kNoCell;
      for (const std::uint32_t d : complex.neighbors[c]) {
        if (d == kNoCell || basins.basin_of_cell[d] == kNoBasin) continue;
        if (best == kNoCell || complex.radii[d] > complex.radii[best]) best = d;
      }
      if (best == kNoCell) {
        rest.push_back(c);
      } else {
        adopted.emplace_back(c, basins.basin_of_cell[best]);
      }
    }
    if (adopted.empty()) {
      adopted.emplace_back(rest.front(), static_cast<std::uint32_t>(basins.maximum.size()));
      basins.maximum.push_back(rest.front());
      rest.erase(rest.begin());
    }
    for (const auto& [cell, basin] : adopted) basins.basin_of_cell[cell] = basin;
    strays = std::move(rest);
  }
}

}  // namespace

Basins find_basins(const DelaunayComplex& complex, const Interior& interior, int threads) {
  const std::vector<std::uint8_t> flow = find_flow(complex, interior, threads);
  Basins basins;
  basins.basin_of_cell.assign(complex.cell_count(), kNoBasin);
  basins.maximum = find_maxima(complex, interior, flow);
  for (std::uint32_t b = 0; b < basins.maximum.size(); ++b) {
    check_cancelled();
    collect(complex, flow, interior, b, basins.maximum[b], basins.basin_of_cell);
  }
  adopt_strays(complex, interior, basins);
  return basins;
}

}  // namespace morsel
