#include "segment/pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/threads.hpp"

namespace morsel {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// How far a piece's cells lie from its seed, in root mean square radii of the object.
constexpr double kPieceRadius = 0.17;
constexpr std::size_t kMostPieces = 400;

// The inner cells by themselves, numbered as in the complex, with their neighbours of the same
// region: much smaller than the complex, and walked through again and again.
struct Inside {
  std::vector<std::uint32_t> cells;                     // (k) of the complex
  std::vector<Vec3> centroids;                          // (k)
  std::vector<std::array<std::uint32_t, 4>> neighbors;  // (k, 4) or kNoCell
};

Inside find_inside(const DelaunayComplex& complex, const Basins& basins,
                   const std::vector<std::uint32_t>& region_of_basin, int threads) {
  Inside inside;
  std::vector<std::uint32_t> place(complex.cell_count(), kNoCell);
  for (std::uint32_t c = 0; c < place.size(); ++c) {
    if (basins.basin_of_cell[c] == kNoBasin) continue;
    place[c] = static_cast<std::uint32_t>(inside.cells.size());
    inside.cells.push_back(c);
  }
  const auto region = [&](std::uint32_t c) { return region_of_basin[basins.basin_of_cell[c]]; };
  inside.centroids.resize(inside.cells.size());
  inside.neighbors.resize(inside.cells.size());
  parallel_ranges(inside.cells.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t c = inside.cells[i];
      inside.centroids[i] = cell_centroid(complex, c);
      for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t d = complex.neighbors[c][k];
        const bool beside = d != kNoCell && place[d] != kNoCell && region(d) == region(c);
        inside.neighbors[i][k] = beside ? place[d] : kNoCell;
      }
    }
  });
  return inside;
}

// Root mean square distance of each object's cells from their centroid, weighted by cell: cells
// crowd where the surface is, so this measures the surface rather than the volume.
std::vector<double> object_extents(const Inside& inside, const Basins& basins,
                                   const std::vector<std::uint32_t>& object_of_basin) {
  std::vector<double> count(basins.count(), 0.0);
  std::vector<Vec3> mean(basins.count());
  std::vector<double> squares(basins.count(), 0.0);
  const auto object_of = [&](std::size_t i) {
    return object_of_basin[basins.basin_of_cell[inside.cells[i]]];
  };
  for (std::size_t i = 0; i < inside.cells.size(); ++i) {
    count[object_of(i)] += 1.0;
    mean[object_of(i)] = mean[object_of(i)] + inside.centroids[i];
  }
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] > 0.0) mean[i] = (1.0 / count[i]) * mean[i];
  }
  for (std::size_t i = 0; i < inside.cells.size(); ++i) {
    squares[object_of(i)] += squared_distance(inside.centroids[i], mean[object_of(i)]);
  }
  for (std::size_t i = 0; i < count.size(); ++i) {
    squares[i] = count[i] > 0.0 ? std::sqrt(squares[i] / count[i]) : 0.0;
  }
  return squares;
}

// Voronoi regions of seeds inside one region each. The distance of a cell is how far the way from
// the seed must stray from it: the lengths of paths from cell to cell would depend on the sampling,
// as they zigzag the more, the longer and thinner the cells are.
class Growth {
 public:
  // `may_seed[i]` says which cells can become a seed.
  Growth(const Inside& inside, std::vector<bool> may_seed)
      : inside_(inside), may_seed_(std::move(may_seed)), piece_(inside.cells.size(), kNoBasin) {
    places_.reserve(inside.cells.size());
    for (const Vec3& centroid : inside.centroids) places_.push_back({centroid, kInfinity});
  }

  [[nodiscard]] const std::vector<std::uint32_t>& piece_of_cell() const { return piece_; }

  // The cell that lies farthest from its piece's seed, in extents of the piece, among those that
  // can become a seed; kNoCell when none lies farther than `least`.
  std::uint32_t next_seed(const std::vector<double>& extent, double least) {
    while (true) {
      double most = least;
      std::uint32_t piece = kNoBasin;
      for (std::uint32_t k = 0; k < farthest_.size(); ++k) {
        const double apart = std::sqrt(farthest_[k].squared) / extent[k];
        const bool tied = apart == most && piece != kNoBasin;
        if (apart > most || (tied && farthest_[k].cell > farthest_[piece].cell)) {
          most = apart;
          piece = k;
        }
      }
      if (piece == kNoBasin) return kNoCell;
      if (piece_[farthest_[piece].cell] == piece) return farthest_[piece].cell;
      forget_lost(piece);
    }
  }

  // A new piece takes every cell that is nearer to its seed than to any before; the first of a
  // region takes all that it reaches, at about `reach` from the seed.
  void add(std::uint32_t seed, double reach) {
    const auto piece = static_cast<std::uint32_t>(farthest_.size());
    const Vec3 center = places_[seed].centroid;
    std::vector<Candidate>& candidates = candidates_.emplace_back();
    for (const std::uint32_t c : grow(seed, piece, reach)) {
      if (!may_seed_[c]) continue;
      candidates.push_back({places_[c].squared, squared_distance(center, places_[c].centroid), c});
    }
    farthest_.push_back(farthest_of(candidates));
  }

 private:
  // Cells wait in buckets, the nearest first, and are visited again when a way that strays less is
  // found to them; in the end each holds the least, in whatever order they were visited.
  std::vector<std::uint32_t> grow(std::uint32_t seed, std::uint32_t piece, double reach) {
    const Vec3 center = places_[seed].centroid;
    // Hardly anything is taken from farther than the seed lies from the one before.
    const double farthest = std::min(places_[seed].squared, reach * reach);
    const double scale = farthest > 0.0 ? kBuckets / farthest : 0.0;
    const auto bucket_of = [&](double squared) {
      return static_cast<std::size_t>(std::min(scale * squared, kBuckets - 1.0));
    };
    std::vector<std::uint32_t> taken;
    const auto take = [&](std::uint32_t c, double squared) {
      places_[c].squared = squared;
      if (piece_[c] != piece) taken.push_back(c);
      piece_[c] = piece;
      __builtin_prefetch(&inside_.neighbors[c]);
      buckets_[bucket_of(squared)].push_back(c);
    };
    take(seed, 0.0);
    for (std::size_t b = 0; b < buckets_.size(); ++b) {
      check_cancelled();
      for (std::size_t i = 0; i < std::min(kAhead, buckets_[b].size()); ++i) {
        prefetch_neighbors(buckets_[b][i]);
      }
      for (std::size_t i = 0; i < buckets_[b].size(); ++i) {
        if (i + kAhead < buckets_[b].size()) prefetch_neighbors(buckets_[b][i + kAhead]);
        const std::uint32_t c = buckets_[b][i];
        const double reached = places_[c].squared;
        if (bucket_of(reached) < b) continue;
        for (const std::uint32_t d : inside_.neighbors[c]) {
          if (d == kNoCell || places_[d].squared <= reached) continue;
          const double squared = std::max(reached, squared_distance(center, places_[d].centroid));
          if (squared < places_[d].squared) take(d, squared);
        }
      }
      buckets_[b].clear();
    }
    return taken;
  }

  // The cells lie scattered in memory, but which ones come next is known.
  void prefetch_neighbors(std::uint32_t c) const {
    for (const std::uint32_t d : inside_.neighbors[c]) {
      if (d != kNoCell) __builtin_prefetch(&places_[d]);
    }
  }

  // All cells behind the farthest of a way have its distance: of those the one that lies farthest
  // itself. Their numbers, which depend on the pose, decide between equals alone.
  struct Candidate {
    double squared = 0.0;  // of the distance to the seed: of the way there
    double own = 0.0;      // likewise, of the cell itself
    std::uint32_t cell = 0;
    friend auto operator<=>(const Candidate&, const Candidate&) = default;
  };

  static Candidate farthest_of(const std::vector<Candidate>& candidates) {
    Candidate best;
    for (const Candidate& candidate : candidates) best = std::max(best, candidate);
    return best;
  }

  void forget_lost(std::uint32_t piece) {
    std::erase_if(candidates_[piece], [&](const Candidate& c) { return piece_[c.cell] != piece; });
    farthest_[piece] = farthest_of(candidates_[piece]);
  }

  struct Place {
    Vec3 centroid;
    double squared;  // of the distance to the own piece's seed
  };

  static constexpr double kBuckets = 64.0;
  static constexpr std::size_t kAhead = 8;

  const Inside& inside_;
  std::vector<bool> may_seed_;
  std::vector<Place> places_;
  std::array<std::vector<std::uint32_t>, static_cast<std::size_t>(kBuckets)> buckets_;
  std::vector<std::uint32_t> piece_;
  std::vector<std::vector<Candidate>> candidates_;  // of each piece, and some that it has lost
  std::vector<Candidate> farthest_;                 // of each piece's candidates
};

// Places in `inside` of the largest ball of every region; basins come by decreasing radius.
std::vector<std::uint32_t> region_seeds(const Inside& inside, const Basins& basins,
                                        const std::vector<std::uint32_t>& region_of_basin) {
  std::vector<std::uint32_t> seeds;
  for (std::uint32_t b = 0; b < basins.count(); ++b) {
    if (region_of_basin[b] < seeds.size()) continue;
    const auto found = std::ranges::lower_bound(inside.cells, basins.maximum[b]);
    seeds.push_back(static_cast<std::uint32_t>(found - inside.cells.begin()));
  }
  return seeds;
}

// Cells along the surface, with balls no larger than the spacing, are no seeds.
std::vector<bool> find_possible_seeds(const DelaunayComplex& complex, const Inside& inside,
                                      double spacing) {
  std::vector<bool> may_seed(inside.cells.size());
  for (std::size_t i = 0; i < may_seed.size(); ++i) {
    may_seed[i] = complex.radii[inside.cells[i]] > 1.2 * spacing;
  }
  return may_seed;
}

}  // namespace

Pieces split_regions(const DelaunayComplex& complex, const Basins& basins,
                     const std::vector<std::uint32_t>& region_of_basin,
                     const std::vector<std::uint32_t>& object_of_basin, double spacing, int threads,
                     const std::function<void(std::uint32_t, double)>& on_piece) {
  const Inside inside = find_inside(complex, basins, region_of_basin, threads);
  const std::vector<double> extents = object_extents(inside, basins, object_of_basin);
  Growth growth(inside, find_possible_seeds(complex, inside, spacing));
  Pieces pieces;
  const auto add_piece = [&](std::uint32_t seed) {
    const std::uint32_t cell = inside.cells[seed];
    const std::uint32_t basin = basins.basin_of_cell[cell];
    pieces.region.push_back(region_of_basin[basin]);
    pieces.extent.push_back(extents[object_of_basin[basin]]);
    pieces.seed.push_back(cell);
    on_piece(cell, pieces.extent.back());
    growth.add(seed, 2.0 * pieces.extent.back());
  };
  // The first pieces have the numbers of their regions.
  for (const std::uint32_t seed : region_seeds(inside, basins, region_of_basin)) add_piece(seed);
  // Then around the cell that lies farthest from all seeds, again and again.
  while (pieces.count() < kMostPieces) {
    const std::uint32_t seed = growth.next_seed(pieces.extent, kPieceRadius);
    if (seed == kNoCell) break;
    add_piece(seed);
  }
  // Cells that no path through their region reaches stay with their region's first piece.
  pieces.piece_of_cell.assign(complex.cell_count(), kNoBasin);
  for (std::size_t i = 0; i < inside.cells.size(); ++i) {
    const std::uint32_t c = inside.cells[i];
    const std::uint32_t piece = growth.piece_of_cell()[i];
    pieces.piece_of_cell[c] = piece != kNoBasin ? piece : region_of_basin[basins.basin_of_cell[c]];
  }
  return pieces;
}

}  // namespace morsel
