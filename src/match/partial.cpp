// Laying a piece onto a whole: pairs of landmarks of like surroundings propose, distances of points
// to planes refine, and the best fit is the answer.

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <morsel/error.hpp>
#include <morsel/partial.hpp>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "base/threads.hpp"
#include "match/align.hpp"
#include "match/surface.hpp"

namespace morsel {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Data = Surface::Data;

constexpr std::size_t kPieceLandmarks = 50;
constexpr std::size_t kCandidates = 10;  // like surroundings that are kept of each landmark
constexpr std::size_t kPairs = 400;      // of landmarks of the piece that are tried
constexpr double kApart = 0.7;           // least distance of such a pair
constexpr double kSteep = 0.9;           // cosine beyond which a normal along the pair says nothing
constexpr double kSameCosine = 0.3;      // most by which angles of like pairs differ
constexpr double kSameNormal = 0.8;      // least cosine of normals laid onto each other
constexpr double kSameLength = 0.12;     // most by which lengths differ when the scale is known
constexpr double kSameScale = 1.25;      // and their ratio from that of the surroundings otherwise
constexpr double kCoarse = 0.15;         // distance at which a point counts half at first
constexpr double kFine = 0.05;           // and at last
constexpr std::size_t kFirstLook = 16;   // landmarks by which most proposals are dismissed
constexpr std::size_t kRefined = 4;      // proposals
constexpr int kRounds = 6;               // of refinement, half of them coarse
constexpr std::size_t kRefiningPoints = 200;
constexpr std::size_t kScoredPoints = 500;
constexpr double kMargin = 0.06;  // what is so near to the hull is not within it
constexpr double kExcess = 0.5;   // weight of what the whole has beside the piece
// All lengths above are in sizes of the piece.

// x ↦ scale · turn · x + shift, from the piece to the whole.
struct Placement {
  Matrix3d turn = Matrix3d::Identity();
  Vector3d shift = Vector3d::Zero();
  double scale = 1.0;
  double fit = 0.0;

  [[nodiscard]] Vec3 operator()(const Vec3& p) const {
    return as_point(scale * (turn * as_vector(p)) + shift);
  }
  [[nodiscard]] Vec3 back(const Vec3& p) const {
    return as_point(turn.transpose() * (as_vector(p) - shift) / scale);
  }
};

struct Candidate {
  float apart = 0.0F;
  std::size_t landmark = 0;
  std::size_t scale = 0;
};

float difference(const Surroundings& a, const Surroundings& b) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// The scales of the whole that the piece may have: with a known one only those whose radius is
// nearly the same.
std::vector<std::size_t> scales_of(const Data& whole, const Data& piece, bool same_scale) {
  std::vector<std::size_t> scales;
  for (std::size_t scale = 0; scale < kScales; ++scale) {
    const double ratio = radius_at(whole, scale) / radius_at(piece, 0);
    if (!same_scale || (ratio < kScaleStep && ratio > 1.0 / kScaleStep)) scales.push_back(scale);
  }
  return scales;
}

std::size_t landmarks_of_piece(const Data& piece) {
  return std::min(kPieceLandmarks, piece.landmarks.size());
}

// For each landmark of the piece those of the whole whose surroundings are most like its own.
std::vector<std::vector<Candidate>> find_candidates(const Data& whole, const Data& piece,
                                                    const std::vector<std::size_t>& scales) {
  std::vector<std::vector<Candidate>> found(landmarks_of_piece(piece));
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < found.size(); ++i) {
    all.clear();
    for (const std::size_t scale : scales) {
      for (std::size_t k = 0; k < whole.landmarks.size(); ++k) {
        all.push_back(
            {difference(piece.surroundings[0][i], whole.surroundings[scale][k]), k, scale});
      }
    }
    const std::size_t kept = std::min(kCandidates, all.size());
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(kept);
    std::partial_sort(all.begin(), end, all.end(), [](const Candidate& a, const Candidate& b) {
      return std::tie(a.apart, a.scale, a.landmark) < std::tie(b.apart, b.scale, b.landmark);
    });
    found[i].assign(all.begin(), end);
  }
  return found;
}

// Two landmarks, the way from one to the other and the angles of their normals.
struct Pair {
  Pair(const Data& surface, std::uint32_t first, std::uint32_t second)
      : a(as_vector(surface.points[first])),
        b(as_vector(surface.points[second])),
        normal_a(as_vector(surface.normals[first])),
        normal_b(as_vector(surface.normals[second])),
        length((b - a).norm()),
        way((b - a) / length),
        cosines{std::abs(normal_a.dot(way)), std::abs(normal_b.dot(way)),
                std::abs(normal_a.dot(normal_b))} {}

  [[nodiscard]] bool like(const Pair& other) const {
    for (std::size_t i = 0; i < cosines.size(); ++i) {
      if (!(std::abs(cosines[i] - other.cosines[i]) <= kSameCosine)) return false;
    }
    return true;
  }
  /// Axes along the way and across it, towards the normal that leans less to it.
  [[nodiscard]] Matrix3d frame(bool by_second) const {
    const Vector3d& normal = by_second ? normal_b : normal_a;
    const Vector3d across = (normal - normal.dot(way) * way).normalized();
    Matrix3d axes;
    axes << way, across, way.cross(across);
    return axes;
  }

  Vector3d a, b, normal_a, normal_b;
  double length;
  Vector3d way;
  std::array<double, 3> cosines;
};

// The pairs of landmarks of the piece that are far apart, at most kPairs of them.
std::vector<std::array<std::size_t, 2>> choose_pairs(const Data& piece) {
  std::vector<std::array<std::size_t, 2>> pairs;
  const std::size_t count = landmarks_of_piece(piece);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i + 1; k < count; ++k) {
      const Pair pair(piece, piece.landmarks[i], piece.landmarks[k]);
      if (pair.length > kApart * piece.size &&
          std::min(pair.cosines[0], pair.cosines[1]) < kSteep) {
        pairs.push_back({i, k});
      }
    }
  }
  Random random(1);
  for (std::size_t i = pairs.size(); i > 1; --i) std::swap(pairs[i - 1], pairs[random.below(i)]);
  pairs.resize(std::min(pairs.size(), kPairs));
  return pairs;
}

// Keeps the best proposals.
class Proposals {
 public:
  Proposals(const Data& whole, const Data& piece) : whole_(whole), piece_(piece) {}

  void offer(Placement placement) {
    const double limit = best_.size() < kRefined ? 0.0 : best_.back().fit;
    const std::size_t count = landmarks_of_piece(piece_);
    const double coarse = kCoarse * piece_.size * placement.scale;
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double apart =
          whole_.tree->nearest(placement(piece_.points[piece_.landmarks[i]])).distance / coarse;
      sum += std::max(0.0, 1.0 - apart * apart);
      // What does not lie much on the whole by now will not be among the best.
      const double share = static_cast<double>(i + 1) / static_cast<double>(count);
      if (i + 1 == kFirstLook && sum < 0.9 * share * limit) return;
    }
    if (!(sum > limit)) return;
    placement.fit = sum;
    const auto at = std::ranges::upper_bound(best_, sum, std::ranges::greater{}, &Placement::fit);
    best_.insert(at, placement);
    if (best_.size() > kRefined) best_.pop_back();
  }
  [[nodiscard]] const std::vector<Placement>& best() const { return best_; }

 private:
  const Data& whole_;
  const Data& piece_;
  std::vector<Placement> best_;  // by decreasing fit
};

// All ways to lay one pair onto the other with both normals onto each other.
void offer_ways(const Pair& whole, const Pair& piece, double scale, bool mirror,
                Proposals& proposals) {
  const bool by_second = piece.cosines[0] > piece.cosines[1];
  if (!(whole.cosines[by_second ? 1 : 0] < kSteep)) return;
  const Matrix3d from = piece.frame(by_second);
  for (const double side : {1.0, -1.0}) {
    for (const double hand : {1.0, -1.0}) {
      if (hand < 0.0 && !mirror) continue;
      Matrix3d to = whole.frame(by_second);
      to.col(1) *= side;
      to.col(2) *= side * hand;
      Placement placement;
      placement.turn = to * from.transpose();
      if (std::abs((placement.turn * piece.normal_a).dot(whole.normal_a)) < kSameNormal ||
          std::abs((placement.turn * piece.normal_b).dot(whole.normal_b)) < kSameNormal) {
        continue;
      }
      placement.scale = scale;
      placement.shift =
          0.5 * (whole.a + whole.b) - scale * (placement.turn * (0.5 * (piece.a + piece.b)));
      proposals.offer(placement);
    }
  }
}

// The scale that would lay a pair onto another; 0 when the surroundings or the unit say otherwise.
double scale_between(const Pair& whole, const Pair& piece, double expected, double size,
                     bool same_scale) {
  if (same_scale) return std::abs(whole.length - piece.length) < kSameLength * size ? 1.0 : 0.0;
  const double scale = whole.length / piece.length;
  return scale < kSameScale * expected && kSameScale * scale > expected ? scale : 0.0;
}

std::vector<Placement> propose(const Data& whole, const Data& piece, const MatchOptions& options) {
  const std::vector<std::size_t> scales = scales_of(whole, piece, options.same_scale);
  const auto candidates = find_candidates(whole, piece, scales);
  Proposals proposals(whole, piece);
  for (const auto& [i, k] : choose_pairs(piece)) {
    const Pair from(piece, piece.landmarks[i], piece.landmarks[k]);
    for (const Candidate& x : candidates[i]) {
      for (const Candidate& y : candidates[k]) {
        if (x.landmark == y.landmark || std::max(x.scale, y.scale) - std::min(x.scale, y.scale) > 1)
          continue;
        const Pair to(whole, whole.landmarks[x.landmark], whole.landmarks[y.landmark]);
        const double expected =
            std::sqrt(radius_at(whole, x.scale) * radius_at(whole, y.scale)) / radius_at(piece, 0);
        const double scale = scale_between(to, from, expected, piece.size, options.same_scale);
        if (scale > 0.0 && from.like(to)) offer_ways(to, from, scale, options.mirror, proposals);
      }
    }
  }
  return proposals.best();
}

// Every how many-th of the points is looked at, so that it is about `count` of them.
std::size_t stride_for(const Data& surface, std::size_t count) {
  return std::max<std::size_t>(1, surface.points.size() / count);
}

using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Vector7 = Eigen::Matrix<double, 7, 1>;

// One step towards the planes of the nearest points: turn, shift and scale about the piece's
// centre, those far away count little. Returns whether anything moved.
bool step_closer(const Data& whole, const Data& piece, double reach, bool same_scale,
                 Placement& placement) {
  const std::size_t stride = stride_for(piece, kRefiningPoints);
  const Vector3d center = as_vector(placement(piece.center));
  const double unit = piece.size * placement.scale;
  const double limit = reach * unit;
  Matrix7 squares = Matrix7::Zero();
  Vector7 pull = Vector7::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < piece.points.size(); i += stride) {
    const Vec3 at = placement(piece.points[i]);
    const PointTree::Hit hit = whole.tree->nearest(at);
    if (hit.distance > 2.0 * limit) continue;
    const double share = hit.distance / limit;
    const double weight = 1.0 / ((1.0 + share * share) * (1.0 + share * share));
    const Vector3d normal = as_vector(whole.normals[hit.index]);
    const Vector3d arm = (as_vector(at) - center) / unit;
    const double off = normal.dot(as_vector(at) - as_vector(whole.points[hit.index])) / unit;
    Vector7 row;
    row << arm.cross(normal), normal, same_scale ? 0.0 : arm.dot(normal);
    squares += weight * row * row.transpose();
    pull += weight * off * row;
    count += 1.0;
  }
  constexpr double kFewest = 10.0;
  if (count < kFewest) return false;
  // Keeps what the points do not tell, such as a slide along a cylinder, as it is.
  constexpr double kDamping = 3e-4;
  squares.diagonal().array() += kDamping * count;
  squares(6, 6) += 2.0 * kDamping * count;
  const Vector7 step = -squares.ldlt().solve(pull);
  const Vector3d axis = step.head<3>();
  const double angle = axis.norm();
  if (angle > 0.0) placement.turn = Eigen::AngleAxisd(angle, axis / angle) * placement.turn;
  placement.scale *= std::clamp(1.0 + step[6], 0.8, 1.25);
  placement.shift = center + unit * step.segment<3>(3) -
                    placement.scale * (placement.turn * as_vector(piece.center));
  constexpr double kStill = 1e-4;
  return step.norm() > kStill;
}

// Half-spaces around the piece, a little inside its convex hull.
class Hull {
 public:
  explicit Hull(const Data& piece) {
    // Directions spread evenly along a spiral.
    constexpr int kDirections = 80;
    for (int i = 0; i < kDirections; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
      const double around = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
      const double radius = std::sqrt(1.0 - z * z);
      const Vec3 direction{radius * std::cos(around), radius * std::sin(around), z};
      double most = -std::numeric_limits<double>::infinity();
      for (const Vec3& p : piece.points) most = std::max(most, dot(direction, p));
      sides_.push_back({direction, most - kMargin * piece.size});
    }
  }
  [[nodiscard]] bool contains(const Vec3& p) const {
    return std::ranges::all_of(
        sides_, [&](const Side& side) { return dot(side.direction, p) < side.limit; });
  }

 private:
  struct Side {
    Vec3 direction;
    double limit;
  };
  std::vector<Side> sides_;
};

// Share of the piece's area that lies on the whole, by distance from its planes and by normals.
double covered(const Data& whole, const Data& piece, const Placement& placement) {
  const double unit = kFine * piece.size * placement.scale;
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < piece.points.size(); i += stride_for(piece, kScoredPoints)) {
    const Vec3 at = placement(piece.points[i]);
    const PointTree::Hit hit = whole.tree->nearest(at);
    const Vec3& normal = whole.normals[hit.index];
    const double off = dot(normal, at - whole.points[hit.index]);
    // Points are so far apart anyway.
    const double beside =
        std::max(0.0, std::sqrt(std::max(0.0, hit.distance * hit.distance - off * off)) -
                          1.5 * whole.spacing);
    const double apart = (off * off + beside * beside) / (unit * unit);
    const Vector3d turned = placement.turn * as_vector(piece.normals[i]);
    const double parallel = std::abs(turned.dot(as_vector(normal)));
    sum += piece.areas[i] * (0.5 + 0.5 * parallel) / (1.0 + apart);
    area += piece.areas[i];
  }
  return sum / area;
}

// Area of the whole that lies within the piece's hull, but not on the piece, over that of the
// piece.
double excess(const Data& whole, const Data& piece, const Hull& hull, const Placement& placement) {
  const double unit = 2.0 * kFine * piece.size;
  const std::size_t stride = stride_for(whole, kScoredPoints);
  double sum = 0.0;
  for (std::size_t i = 0; i < whole.points.size(); i += stride) {
    const Vec3 at = placement.back(whole.points[i]);
    if (!hull.contains(at)) continue;
    const double share = piece.tree->nearest(at).distance / unit;
    sum += whole.areas[i] * share * share / (1.0 + share * share);
  }
  double area = 0.0;
  for (const double of_point : piece.areas) area += of_point;
  return static_cast<double>(stride) * sum / (placement.scale * placement.scale * area);
}

Placement place(const Data& whole, const Data& piece, const MatchOptions& options) {
  const Hull hull(piece);
  Placement best;
  for (Placement placement : propose(whole, piece, options)) {
    for (int round = 0; round < kRounds; ++round) {
      const double reach = round < kRounds / 2 ? kCoarse : 2.0 * kFine;
      if (!step_closer(whole, piece, reach, options.same_scale, placement)) break;
    }
    placement.fit = std::max(
        0.0, covered(whole, piece, placement) - kExcess * excess(whole, piece, hull, placement));
    if (placement.fit > best.fit) best = placement;
  }
  return best;
}

// Each part of the piece goes to the one on which most of its points lie.
void pair_parts(const Data& whole, const Data& piece, const Placement& placement, Match& result) {
  const int targets = 1 + *std::ranges::max_element(whole.parts);
  const int sources = 1 + *std::ranges::max_element(piece.parts);
  std::vector<std::vector<std::size_t>> common(sources, std::vector<std::size_t>(targets, 0));
  std::vector<std::size_t> of_source(sources, 0);
  const double near = 2.0 * kFine * piece.size * placement.scale + whole.spacing;
  for (std::size_t i = 0; i < piece.points.size(); ++i) {
    if (piece.parts[i] < 0) continue;
    ++of_source[piece.parts[i]];
    const PointTree::Hit hit = whole.tree->nearest(placement(piece.points[i]));
    if (hit.distance < near && whole.parts[hit.index] >= 0) {
      ++common[piece.parts[i]][whole.parts[hit.index]];
    }
  }
  std::vector<bool> taken(targets, false);
  for (int source = 0; source < sources; ++source) {
    const auto most = std::ranges::max_element(common[source]);
    if (most == common[source].end() || 2 * *most < of_source[source] || *most == 0) {
      result.unmatched_source.push_back(source);
      continue;
    }
    const int target = static_cast<int>(most - common[source].begin());
    taken[target] = true;
    result.matched.push_back(
        {target, source, static_cast<double>(*most) / static_cast<double>(piece.points.size())});
  }
  std::ranges::stable_sort(result.matched, std::ranges::greater{}, &MatchedPart::contribution);
  for (int target = 0; target < targets; ++target) {
    if (!taken[target]) result.unmatched_target.push_back(target);
  }
}

}  // namespace

double recurrence(const Surface& whole, const Surface& piece, const MatchOptions& options) {
  const Data& from = piece.data();
  const Data& to = whole.data();
  if (!(from.size > 0.0) || !(to.size > 0.0)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t count = landmarks_of_piece(from);
  for (const std::size_t scale : scales_of(to, from, options.same_scale)) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      float nearest = std::numeric_limits<float>::infinity();
      for (const Surroundings& other : to.surroundings[scale]) {
        nearest = std::min(nearest, difference(from.surroundings[0][i], other));
      }
      sum += std::sqrt(static_cast<double>(nearest));
    }
    least = std::min(least, sum / static_cast<double>(count));
  }
  return std::exp(-least);
}

Match match_partial(const Surface& whole, const Surface& piece, const MatchOptions& options) {
  options.check();
  Match result;
  const Data& to = whole.data();
  const Data& from = piece.data();
  if (!(from.size > 0.0) || !(to.size > 0.0)) return result;
  const Placement placement = place(to, from, options);
  result.score = std::min(1.0, placement.fit);
  result.target_from_source = as_matrix(placement.scale * placement.turn, placement.shift);
  result.mirrored = placement.turn.determinant() < 0.0;
  pair_parts(to, from, placement, result);
  return result;
}

std::vector<Hit> search_partial(const Surface& piece, std::size_t count,
                                const std::function<Surface(std::size_t)>& whole, std::size_t top,
                                const MatchOptions& options, int threads,
                                const Progress* progress) {
  constexpr std::size_t kAligned = 50;
  options.check();
  const auto by_score = [](const Hit& a, const Hit& b) {
    return a.score != b.score ? a.score > b.score : a.index < b.index;
  };
  std::vector<Hit> hits(count);
  std::atomic<std::size_t> done{0};
  parallel_rows(count, threads, [&](std::size_t i) {
    if (progress != nullptr) progress->check();
    hits[i] = {i, recurrence(whole(i), piece, options)};
    if (progress != nullptr) {
      progress->report("compare", static_cast<double>(++done) / static_cast<double>(count));
    }
  });
  std::ranges::sort(hits, by_score);
  hits.resize(std::min(count, std::max(kAligned, 2 * top)));
  parallel_rows(hits.size(), threads, [&](std::size_t i) {
    if (progress != nullptr) progress->check();
    hits[i].score = match_partial(whole(hits[i].index), piece, options).score;
  });
  std::ranges::sort(hits, by_score);
  hits.resize(std::min(top, hits.size()));
  return hits;
}

}  // namespace morsel
