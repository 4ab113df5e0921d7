#include "segment/sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "delaunay/balls.hpp"

namespace morsel {
namespace {

// Root mean square radii of the object at which a pair's weight has fallen to 1/e.
constexpr double kSightScale = 0.65;
// Pairs farther apart, of weights below 0.2, are not looked at.
constexpr double kSightReach = 0.85;
// Of pairs farther apart than this, by far the most and the longest walks, every second is looked
// at and counts for two.
constexpr double kAllWithin = 0.6;

// How many walks take turns: each waits for memory at every step, and meanwhile the others go on.
constexpr std::size_t kAbreast = 12;

enum class Outcome : std::uint8_t {
  kUnderway,
  kInside,   // arrived, having left the inside for at most `tolerance` units in all
  kOutside,  // has left it for longer
};

// A straight walk from cell to cell along the segment between two cells' centroids. Each corner is
// seen from the start along the way, as x and y across it. The way leaves a cell through the facet
// whose image holds the origin.
class SegmentWalk {
 public:
  SegmentWalk() = default;
  SegmentWalk(const DelaunayComplex& complex, std::uint32_t from, std::uint32_t to,
              const Vec3& start, const Vec3& end, double tolerance)
      : view_(start, end), to_(to), allowed_(tolerance / view_.length()) {
    cell_ = from;
    if (from != to) leave_first(complex);
  }

  // Enters the cell behind the facet held, and goes on to the facet of leaving it.
  Outcome advance(const DelaunayComplex& complex, const std::vector<CellSide>& side) {
    const bool inner = cell_ != kNoCell && side[cell_] == CellSide::kInner;
    if (!inner || !inner_) {
      const double here = std::clamp(height(complex), entered_, 1.0);
      if (!inner_) allowed_ -= here - entered_;
      entered_ = here;
      inner_ = inner;
      if (allowed_ < 0.0) return Outcome::kOutside;
      if (here >= 1.0) return Outcome::kInside;  // the end lies in a neighbour, as rounding has it
      if (cell_ == kNoCell) return Outcome::kOutside;
    }
    if (cell_ == to_ || walks_in_circle()) return Outcome::kInside;
    const std::array<std::uint32_t, 4>& corners = complex.cells[cell_];
    // The corner opposite the facet of entry: what is left of the four without the three.
    const std::uint32_t vertex = corners[0] ^ corners[1] ^ corners[2] ^ corners[3] ^ vertices_[0] ^
                                 vertices_[1] ^ vertices_[2];
    const auto [x, y] = view_.see(complex.vertices[vertex]);
    // Which corners lie to the left of the ray from the origin through the new one.
    unsigned left = 0;
    for (unsigned k = 0; k < 3; ++k) {
      left |= static_cast<unsigned>(x * y_[k] >= y * x_[k]) << k;
    }
    // The ray is met again between a left one and a right one; the third corner is hidden, and the
    // new one takes its place.
    constexpr std::array<std::uint8_t, 8> kHidden{0, 2, 0, 0, 1, 2, 1, 0};
    const std::size_t hidden = kHidden[left];
    cell_ = complex.neighbors[cell_][slot_of(corners, vertices_[hidden])];
    vertices_[hidden] = vertex;
    x_[hidden] = x;
    y_[hidden] = y;
    if (cell_ != kNoCell) {
      __builtin_prefetch(&complex.cells[cell_]);
      __builtin_prefetch(&complex.neighbors[cell_]);
    }
    return Outcome::kUnderway;
  }

 private:
  class View {
   public:
    View() = default;
    View(const Vec3& start, const Vec3& end) : start_(start), way_(end - start) {
      const double length = norm(way_);
      const Vec3 along = (1.0 / length) * way_;
      // Any axis across will do; that of the smallest component is far from parallel.
      const Vec3 size{std::abs(along.x), std::abs(along.y), std::abs(along.z)};
      const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3{1.0, 0.0, 0.0}
                        : size.y <= size.z                   ? Vec3{0.0, 1.0, 0.0}
                                                             : Vec3{0.0, 0.0, 1.0};
      const Vec3 across = cross(along, axis);
      x_ = (1.0 / norm(across)) * across;
      y_ = cross(along, x_);
      // Off the axis by next to nothing, so that regular samples have no corner exactly on it.
      constexpr double kNextToNothing = 1e-9;
      start_ = start_ + kNextToNothing * length * (x_ + 0.6180339887 * y_);
    }
    [[nodiscard]] double length() const { return norm(way_); }
    // Across the way, in units.
    [[nodiscard]] std::pair<double, double> see(const Vec3& p) const {
      const Vec3 d = p - start_;
      return {dot(x_, d), dot(y_, d)};
    }
    // Along the way, 1 at its end.
    [[nodiscard]] double depth(const Vec3& p) const {
      return dot(way_, p - start_) / squared_norm(way_);
    }

   private:
    Vec3 start_;
    Vec3 way_;
    Vec3 x_, y_;
  };

  // Without a branch: which one it is cannot be foreseen.
  static std::size_t slot_of(const std::array<std::uint32_t, 4>& four, std::uint32_t value) {
    return static_cast<std::size_t>(four[1] == value) +
           2 * static_cast<std::size_t>(four[2] == value) +
           3 * static_cast<std::size_t>(four[3] == value);
  }

  // Twice the signed area of the origin and two corners.
  template <typename Coordinates>
  static double turn(const Coordinates& x, const Coordinates& y, std::size_t a, std::size_t b) {
    return x[a] * y[b] - y[a] * x[b];
  }

  // Where the segment meets the facet held.
  [[nodiscard]] double height(const DelaunayComplex& complex) const {
    const auto depth = [&](std::size_t k) { return view_.depth(complex.vertices[vertices_[k]]); };
    const double wa = turn(x_, y_, 1, 2);
    const double wb = turn(x_, y_, 2, 0);
    const double wc = turn(x_, y_, 0, 1);
    const double sum = wa + wb + wc;
    return sum > 0.0 ? (wa * depth(0) + wb * depth(1) + wc * depth(2)) / sum : depth(0);
  }

  // Out of the first cell through the facet whose image holds the origin most clearly.
  void leave_first(const DelaunayComplex& complex) {
    const std::array<std::uint32_t, 4>& corners = complex.cells[cell_];
    std::array<double, 4> x{};
    std::array<double, 4> y{};
    for (std::size_t k = 0; k < 4; ++k) {
      std::tie(x[k], y[k]) = view_.see(complex.vertices[corners[k]]);
    }
    std::size_t best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t slot = 0; slot < 4; ++slot) {
      const auto& [a, b, c] = kFacetSlots[slot];
      const double least = std::min({turn(x, y, a, b), turn(x, y, b, c), turn(x, y, c, a)});
      if (least <= most) continue;
      most = least;
      best = slot;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = static_cast<std::size_t>(kFacetSlots[best][k]);
      vertices_[k] = corners[corner];
      x_[k] = x[corner];
      y_[k] = y[corner];
    }
    cell_ = complex.neighbors[cell_][best];
  }

  // A straight walk meets no cell twice; where cells are flat, rounding may turn it in a circle
  // (R. P. Brent's test finds any within twice its length). Nothing outside was met on it.
  [[nodiscard]] bool walks_in_circle() {
    if (cell_ == milestone_) return true;
    if (++step_ == next_milestone_) {
      milestone_ = cell_;
      next_milestone_ *= 2;
    }
    return false;
  }

  View view_;
  // The facet held: counter-clockwise as seen by the eye of the walk.
  std::array<double, 3> x_{};
  std::array<double, 3> y_{};
  std::array<std::uint32_t, 3> vertices_{};
  std::uint32_t cell_ = kNoCell;  // behind it
  std::uint32_t to_ = kNoCell;
  std::uint32_t milestone_ = kNoCell;
  std::uint32_t step_ = 0;
  std::uint32_t next_milestone_ = 64;
  bool inner_ = true;     // before it
  double allowed_ = 0.0;  // outside, as a share of the segment
  double entered_ = 0.0;  // where the segment last left or entered the inside, as a share
};

}  // namespace

SightSearch::SightSearch(const DelaunayComplex& complex, const Interior& interior, double spacing,
                         int threads)
    : complex_(complex), interior_(interior), spacing_(spacing), walks_(threads) {}

void SightSearch::add(std::uint32_t seed, double extent) {
  places_.push_back({seed, cell_centroid(complex_, seed)});
  Row& row = rows_.emplace_back();
  walks_.run([this, places = places_, extent, &row] { fill(places, extent, row); });
}

// From the last of `places` to all near enough to count.
void SightSearch::fill(const std::vector<Place>& places, double extent, Row& row) const {
  const Place& from = places.back();
  row.seen.assign(places.size(), 0.0F);
  row.weight.assign(places.size(), 0.0F);
  row.seen.back() = row.weight.back() = 1.0F;
  struct Underway {
    SegmentWalk walk;
    std::size_t goal;
  };
  std::array<Underway, kAbreast> underway;
  std::size_t count = 0;
  const auto start = [&](std::size_t goal) {
    const Place& to = places[goal];
    const double relative = distance(from.centroid, to.centroid) / extent;
    if (!(relative < kSightReach)) return;
    const bool one_for_two = relative >= kAllWithin;
    if (one_for_two && (goal + places.size()) % 2 == 0) return;
    const double scaled = relative / kSightScale;
    row.weight[goal] = static_cast<float>((one_for_two ? 2.0 : 1.0) * std::exp(-scaled * scaled));
    underway[count++] = {
        SegmentWalk(complex_, from.cell, to.cell, from.centroid, to.centroid, 0.5 * spacing_),
        goal};
  };
  std::size_t next = 0;
  while (true) {
    while (next + 1 < places.size() && count < kAbreast) start(next++);
    if (count == 0) break;
    for (std::size_t i = 0; i < count;) {
      const Outcome outcome = underway[i].walk.advance(complex_, interior_.side);
      if (outcome == Outcome::kUnderway) {
        ++i;
        continue;
      }
      row.seen[underway[i].goal] = outcome == Outcome::kInside ? 1.0F : 0.0F;
      underway[i] = underway[--count];
    }
  }
}

SightTable SightSearch::table() {
  walks_.wait();
  const std::size_t count = rows_.size();
  SightTable table;
  table.seen.resize(count * count);
  table.weight.resize(count * count);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      table.seen[a * count + b] = table.seen[b * count + a] = rows_[a].seen[b];
      table.weight[a * count + b] = table.weight[b * count + a] = rows_[a].weight[b];
    }
  }
  return table;
}

}  // namespace morsel
