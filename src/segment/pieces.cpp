#include "segment/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace morsel {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// How far a piece's cells lie from its seed, in root mean square radii of the object.
constexpr double kPieceRadius = 0.17;
constexpr std::size_t kMostPieces = 400;

using Entry = std::pair<double, std::uint32_t>;

// Grows Voronoi regions of seeds through the cells of one region. The distance of a cell is how far
// the way from the seed must stray from it: the lengths of paths from cell to cell would depend on
// the sampling, as they zigzag the more, the longer and thinner the cells are.
class SeedField {
 public:
  SeedField(const DelaunayComplex& complex, const std::vector<std::uint32_t>& region_of_cell)
      : complex_(complex),
        region_of_cell_(region_of_cell),
        distance_(complex.cell_count(), kInfinity) {
    centroids_.reserve(complex.cell_count());
    for (std::size_t c = 0; c < complex.cell_count(); ++c) {
      centroids_.push_back(cell_centroid(complex, c));
    }
  }

  [[nodiscard]] double distance_to_seed(std::uint32_t cell) const { return distance_[cell]; }

  // Calls claim(cell) for every cell that is now nearer to `seed` than to any seed before.
  template <typename Claim>
  void add(std::uint32_t seed, const Claim& claim) {
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const Vec3 center = centroids_[seed];
    distance_[seed] = 0.0;
    claim(seed);
    queue.emplace(0.0, seed);
    while (!queue.empty()) {
      const auto [reached, c] = queue.top();
      queue.pop();
      if (reached > distance_[c]) continue;
      for (const std::uint32_t d : complex_.neighbors[c]) {
        if (d == kNoCell || region_of_cell_[d] != region_of_cell_[seed]) continue;
        const double next = std::max(reached, distance(center, centroids_[d]));
        if (next >= distance_[d]) continue;
        distance_[d] = next;
        claim(d);
        queue.emplace(next, d);
      }
    }
  }

 private:
  const DelaunayComplex& complex_;
  const std::vector<std::uint32_t>& region_of_cell_;
  std::vector<Vec3> centroids_;
  std::vector<double> distance_;
};

// Root mean square distance of each object's cells from their centroid, weighted by cell: cells
// crowd where the surface is, so this measures the surface rather than the volume.
std::vector<double> object_extents(const DelaunayComplex& complex, const Basins& basins,
                                   const std::vector<std::uint32_t>& object_of_basin) {
  std::vector<double> count(basins.count(), 0.0);
  std::vector<Vec3> mean(basins.count());
  std::vector<double> squares(basins.count(), 0.0);
  const auto each_cell = [&](const auto& visit) {
    for (std::uint32_t c = 0; c < complex.cell_count(); ++c) {
      const std::uint32_t b = basins.basin_of_cell[c];
      if (b != kNoBasin) visit(object_of_basin[b], cell_centroid(complex, c));
    }
  };
  each_cell([&](std::uint32_t object, const Vec3& p) {
    count[object] += 1.0;
    mean[object] = mean[object] + p;
  });
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] > 0.0) mean[i] = (1.0 / count[i]) * mean[i];
  }
  each_cell([&](std::uint32_t object, const Vec3& p) {
    squares[object] += squared_distance(p, mean[object]);
  });
  for (std::size_t i = 0; i < count.size(); ++i) {
    squares[i] = count[i] > 0.0 ? std::sqrt(squares[i] / count[i]) : 0.0;
  }
  return squares;
}

std::vector<std::uint32_t> regions_of_cells(const DelaunayComplex& complex, const Basins& basins,
                                            const std::vector<std::uint32_t>& region_of_basin) {
  std::vector<std::uint32_t> regions(complex.cell_count(), kNoBasin);
  for (std::uint32_t c = 0; c < regions.size(); ++c) {
    const std::uint32_t b = basins.basin_of_cell[c];
    if (b != kNoBasin) regions[c] = region_of_basin[b];
  }
  return regions;
}

// Chooses seeds farthest first and keeps the book of what they become.
class Splitter {
 public:
  Splitter(const DelaunayComplex& complex, const Basins& basins,
           const std::vector<std::uint32_t>& region_of_basin,
           const std::vector<std::uint32_t>& object_of_basin)
      : complex_(complex),
        basins_(basins),
        region_of_basin_(region_of_basin),
        object_of_basin_(object_of_basin),
        extents_(object_extents(complex, basins, object_of_basin)),
        region_of_cell_(regions_of_cells(complex, basins, region_of_basin)),
        field_(complex, region_of_cell_) {
    pieces_.piece_of_cell.assign(complex.cell_count(), kNoBasin);
  }

  // One piece around the largest ball of every region; basins come by decreasing radius.
  void seed_regions() {
    first_piece_.assign(basins_.count(), kNoBasin);
    for (std::uint32_t b = 0; b < basins_.count(); ++b) {
      std::uint32_t& first = first_piece_[region_of_basin_[b]];
      if (first != kNoBasin) continue;
      first = static_cast<std::uint32_t>(pieces_.count());
      add_piece(basins_.maximum[b]);
    }
  }

  // A piece around the cell farthest from all seeds, again and again. Distances only shrink, so an
  // entry of the queue that still holds is the farthest. Cells along the surface, with balls no
  // larger than the spacing, are no seeds.
  void add_farthest(double spacing) {
    std::priority_queue<Entry> farthest;
    for (std::uint32_t c = 0; c < region_of_cell_.size(); ++c) {
      if (region_of_cell_[c] == kNoBasin || complex_.radii[c] <= 1.2 * spacing) continue;
      const double apart = relative_distance(c);
      if (apart > kPieceRadius && apart < kInfinity) farthest.emplace(apart, c);
    }
    while (!farthest.empty() && pieces_.count() < kMostPieces) {
      const auto [apart, c] = farthest.top();
      farthest.pop();
      const double now = relative_distance(c);
      if (now <= kPieceRadius) continue;
      if (now < apart) {
        farthest.emplace(now, c);
      } else {
        add_piece(c);
      }
    }
  }

  // Cells that no path through their region reaches stay with their region's first piece.
  Pieces finish() {
    for (std::uint32_t c = 0; c < region_of_cell_.size(); ++c) {
      if (region_of_cell_[c] != kNoBasin && pieces_.piece_of_cell[c] == kNoBasin) {
        pieces_.piece_of_cell[c] = first_piece_[region_of_cell_[c]];
      }
    }
    return std::move(pieces_);
  }

 private:
  [[nodiscard]] double extent_of(std::uint32_t cell) const {
    return extents_[object_of_basin_[basins_.basin_of_cell[cell]]];
  }

  [[nodiscard]] double relative_distance(std::uint32_t cell) const {
    return field_.distance_to_seed(cell) / extent_of(cell);
  }

  void add_piece(std::uint32_t seed) {
    const auto piece = static_cast<std::uint32_t>(pieces_.count());
    pieces_.region.push_back(region_of_cell_[seed]);
    pieces_.extent.push_back(extent_of(seed));
    pieces_.seed.push_back(seed);
    field_.add(seed, [&](std::uint32_t c) { pieces_.piece_of_cell[c] = piece; });
  }

  const DelaunayComplex& complex_;
  const Basins& basins_;
  const std::vector<std::uint32_t>& region_of_basin_;
  const std::vector<std::uint32_t>& object_of_basin_;
  std::vector<double> extents_;
  std::vector<std::uint32_t> region_of_cell_;
  SeedField field_;
  std::vector<std::uint32_t> first_piece_;
  Pieces pieces_;
};

}  // namespace

Pieces split_regions(const DelaunayComplex& complex, const Basins& basins,
                     const std::vector<std::uint32_t>& region_of_basin,
                     const std::vector<std::uint32_t>& object_of_basin, double spacing) {
  Splitter splitter(complex, basins, region_of_basin, object_of_basin);
  splitter.seed_regions();
  splitter.add_farthest(spacing);
  return splitter.finish();
}

}  // namespace morsel
