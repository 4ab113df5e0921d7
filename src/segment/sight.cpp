#include "segment/sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

// A straight walk from cell to cell along the segment between two cells' centroids. Each corner is
// seen from the start along the way: x and y across it, z along it, 1 at the end. The way leaves a
// cell through the facet whose image holds the origin.
class SegmentWalk {
 public:
  enum class State : std::uint8_t {
    kUnderway,
    kInside,   // arrived, having left the inside for at most `tolerance` units in all
    kOutside,  // has left it for longer
  };

  SegmentWalk(const DelaunayComplex& complex, const Interior& interior, std::uint32_t from,
              std::uint32_t to, const Vec3& start, const Vec3& end, double tolerance)
      : complex_(&complex),
        interior_(&interior),
        view_(start, end),
        to_(to),
        allowed_(tolerance / view_.length()) {
    if (from == to) {
      state_ = State::kInside;
      return;
    }
    cell_ = from;
    inner_ = is_inner(from);
    facet_ = first_facet(from);
    enter_next();
  }

  [[nodiscard]] State state() const { return state_; }

  // A step is two halves, each of which ends by asking for the memory that the next reads. The
  // first looks from the cell just entered for its corner opposite the facet of entry, if the walk
  // goes on.
  void look() {
    // The end may lie in a neighbour, as rounding has it.
    const auto& [a, b, c] = facet_.corners;
    const bool beyond = a.z >= 1.0 && b.z >= 1.0 && c.z >= 1.0;
    if (!within_tolerance()) {
      state_ = State::kOutside;
    } else if (cell_ == to_ || beyond || walks_in_circle()) {
      state_ = State::kInside;
    } else {
      vertex_ = complex_->cells[cell_][slot_of(complex_->neighbors[cell_], previous_)];
      __builtin_prefetch(&complex_->vertices[vertex_]);
    }
  }

  // The second goes from the facet of entry to that of leaving, where the new corner takes the
  // place of the one that it hides, and through it.
  void step() {
    const Vec3 corner = view_.see(complex_->vertices[vertex_]);
    // Which corners lie to the left of the ray from the origin through the new one.
    unsigned left = 0;
    for (unsigned k = 0; k < 3; ++k) {
      left |= static_cast<unsigned>(turn(corner, facet_.corners[k]) >= 0.0) << k;
    }
    // The ray is met again between a left one and a right one; the third corner is hidden.
    constexpr std::array<std::uint8_t, 8> kHidden{0, 2, 0, 0, 1, 2, 1, 0};
    const std::size_t hidden = kHidden[left];
    facet_.slot = slot_of(complex_->cells[cell_], facet_.vertices[hidden]);
    facet_.corners[hidden] = corner;
    facet_.vertices[hidden] = vertex_;
    enter_next();
  }

 private:
  class View {
   public:
    View(const Vec3& start, const Vec3& end) : start_(start) {
      const Vec3 way = end - start;
      length_ = norm(way);
      const Vec3 along = (1.0 / length_) * way;
      // Any axis across will do; that of the smallest component is far from parallel.
      const Vec3 size{std::abs(along.x), std::abs(along.y), std::abs(along.z)};
      const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3{1.0, 0.0, 0.0}
                        : size.y <= size.z                   ? Vec3{0.0, 1.0, 0.0}
                                                             : Vec3{0.0, 0.0, 1.0};
      const Vec3 across = cross(along, axis);
      x_ = (1.0 / norm(across)) * across;
      y_ = cross(along, x_);
      z_ = (1.0 / length_) * along;
      // Off the axis by next to nothing, so that regular samples have no corner exactly on it.
      constexpr double kNextToNothing = 1e-9;
      start_ = start_ + kNextToNothing * length_ * (x_ + 0.6180339887 * y_);
    }
    [[nodiscard]] double length() const { return length_; }
    [[nodiscard]] Vec3 see(const Vec3& p) const {
      const Vec3 d = p - start_;
      return {dot(x_, d), dot(y_, d), dot(z_, d)};
    }

   private:
    Vec3 start_;
    double length_ = 0.0;
    Vec3 x_, y_, z_;
  };

  // The way out of a cell: counter-clockwise as seen by the eye of the walk.
  struct Facet {
    std::array<Vec3, 3> corners;
    std::array<std::uint32_t, 3> vertices;
    std::size_t slot;  // opposite it, in the cell that is left
  };

  // Without a branch: which one it is cannot be foreseen.
  static std::size_t slot_of(const std::array<std::uint32_t, 4>& four, std::uint32_t value) {
    return static_cast<std::size_t>(four[1] == value) +
           2 * static_cast<std::size_t>(four[2] == value) +
           3 * static_cast<std::size_t>(four[3] == value);
  }

  // Twice the signed area of the origin and two corners.
  static double turn(const Vec3& a, const Vec3& b) { return a.x * b.y - a.y * b.x; }

  // Where the segment meets the facet.
  static double height(const Facet& facet) {
    const auto& [a, b, c] = facet.corners;
    const double wa = turn(b, c);
    const double wb = turn(c, a);
    const double wc = turn(a, b);
    const double sum = wa + wb + wc;
    return sum > 0.0 ? (wa * a.z + wb * b.z + wc * c.z) / sum : a.z;
  }

  [[nodiscard]] bool is_inner(std::uint32_t cell) const {
    return interior_->side[cell] == CellSide::kInner;
  }

  // The facet of the first cell whose image holds the origin most clearly.
  [[nodiscard]] Facet first_facet(std::uint32_t cell) const {
    Facet best{};
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t slot = 0; slot < 4; ++slot) {
      Facet facet{};
      facet.slot = slot;
      for (std::size_t k = 0; k < 3; ++k) {
        facet.vertices[k] = complex_->cells[cell][static_cast<std::size_t>(kFacetSlots[slot][k])];
        facet.corners[k] = view_.see(complex_->vertices[facet.vertices[k]]);
      }
      const auto& [a, b, c] = facet.corners;
      const double least = std::min({turn(a, b), turn(b, c), turn(c, a)});
      if (least <= most) continue;
      most = least;
      best = facet;
    }
    return best;
  }

  // Through the facet held, out of the cell.
  void enter_next() {
    previous_ = cell_;
    cell_ = complex_->neighbors[cell_][facet_.slot];

    if (cell_ == kNoCell) {
      state_ = State::kOutside;
      return;
    }
    __builtin_prefetch(&complex_->cells[cell_]);
    __builtin_prefetch(&complex_->neighbors[cell_]);
    __builtin_prefetch(&interior_->side[cell_]);
  }

  // The segment outside ends or begins at the facet held, or goes on.
  [[nodiscard]] bool within_tolerance() {
    const bool was_inner = std::exchange(inner_, is_inner(cell_));
    if (was_inner && inner_) return true;
    const double here = std::clamp(height(facet_), entered_, 1.0);
    if (!was_inner) allowed_ -= here - entered_;
    entered_ = here;
    return allowed_ >= 0.0;
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

  const DelaunayComplex* complex_;
  const Interior* interior_;
  View view_;
  std::uint32_t to_;
  double allowed_;        // outside, as a share of the segment
  double entered_ = 0.0;  // where the segment last left or entered the inside, as a share
  State state_ = State::kUnderway;
  bool inner_ = true;  // the cell
  std::uint32_t cell_ = kNoCell;
  std::uint32_t previous_ = kNoCell;
  std::uint32_t vertex_ = 0;
  Facet facet_{};
  std::uint32_t milestone_ = kNoCell;
  std::size_t step_ = 0;
  std::size_t next_milestone_ = 64;
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
  std::vector<Underway> underway;
  const auto drop_ended = [&] {
    std::erase_if(underway, [&](const Underway& one) {
      if (one.walk.state() == SegmentWalk::State::kUnderway) return false;
      row.seen[one.goal] = one.walk.state() == SegmentWalk::State::kInside ? 1.0F : 0.0F;
      return true;
    });
  };
  const auto start = [&](std::size_t goal) {
    const Place& to = places[goal];
    const double relative = distance(from.centroid, to.centroid) / extent;
    if (!(relative < kSightReach)) return;
    const bool one_for_two = relative >= kAllWithin;
    if (one_for_two && (goal + places.size()) % 2 == 0) return;
    const double scaled = relative / kSightScale;
    row.weight[goal] = static_cast<float>((one_for_two ? 2.0 : 1.0) * std::exp(-scaled * scaled));
    underway.push_back({SegmentWalk(complex_, interior_, from.cell, to.cell, from.centroid,
                                    to.centroid, 0.5 * spacing_),
                        goal});
  };
  std::size_t next = 0;
  while (next + 1 < places.size() || !underway.empty()) {
    while (next + 1 < places.size() && underway.size() < kAbreast) start(next++);
    for (Underway& one : underway) one.walk.look();
    drop_ended();
    for (Underway& one : underway) one.walk.step();
    drop_ended();
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
