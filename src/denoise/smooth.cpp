#include "denoise/smooth.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "base/box.hpp"
#include "base/lanes.hpp"
#include "base/neighborhoods.hpp"
#include "base/quantile.hpp"
#include "base/threads.hpp"
#include "denoise/planes.hpp"

namespace morsel {
namespace {

// Tuned on the development shapes with ids ≡ 1 mod 4 at noise of 0.3% and 0.5% of the diagonal.
constexpr std::size_t kNeighbors = 40;
// Of as many points as are kept fewer reach as far; not fewer than these.
constexpr std::size_t kLeastNeighbors = 16;
constexpr double kPlaneShare = 0.6;  // of the neighbours, the nearest, for planes
constexpr int kNormalRounds = 3;
// Widths of the weights: of the distance, in reaches of the neighbourhood; of 1 - |cos| between
// normals; of the distance from the plane, in medians of the planes' residuals.
constexpr double kDistanceWidth = 0.5;
constexpr double kNormalWidth = 0.3;
constexpr double kHeightWidth = 2.0;

// exp(-x) but for its tail, and cheaper.
Lanes falloff(Lanes x) {
  const Lanes base = not_negative(1.0F - 0.125F * x);
  const Lanes fourth = base * base * base * base;
  return fourth * fourth;
}

// How much neighbours count.
class Weights {
 public:
  Weights(double reach, double height_width)
      : distance_(narrow(0.5 / (kDistanceWidth * kDistanceWidth * reach * reach))),
        height_(narrow(0.5 / (height_width * height_width))) {}

  [[nodiscard]] Lanes operator()(Lanes squared_distance, Lanes cosine, Lanes height) const {
    constexpr auto kNormal = static_cast<float>(0.5 / (kNormalWidth * kNormalWidth));
    const Lanes turn = 1.0F - abs(cosine);
    return falloff(distance_ * squared_distance + kNormal * turn * turn +
                   height_ * height * height);
  }

 private:
  static float narrow(double value) {
    return static_cast<float>(std::min<double>(value, std::numeric_limits<float>::max()));
  }

  float distance_;
  float height_;
};

Spot narrow(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// A cloud, and of which of its points a round is: the others have the normals of those.
struct Stage {
  const std::vector<Vec3>& points;       // (k)
  const std::vector<std::uint32_t>& of;  // (m) indices of points
  const std::vector<std::uint32_t>& by;  // (k) index into `of`
  Neighborhoods neighborhoods;           // (m) among points
  std::size_t inner;                     // so many of them have a plane laid through
  double height_width;                   // tells noise from another sheet; 0: as the planes say
};

// The cloud about its middle in units of its size, as floats: they hold it to a hundred thousandth
// of the spacing, and nothing overflows. One place more, far from all others and without a normal,
// counts nothing and fills up neighbourhoods.
struct Field {
  std::vector<Spot> points;   // (k + 1)
  std::vector<Spot> normals;  // (k + 1)
  double unit;
};

Field make_field(const std::vector<Vec3>& points) {
  const Box box = bounding_box(points);
  const Vec3 middle = 0.5 * (box.low + box.high);
  Field field{{}, {}, box.longest_side()};
  field.points.reserve(points.size() + 1);
  for (const Vec3& p : points) field.points.push_back(narrow((1.0 / field.unit) * (p - middle)));
  field.points.push_back({1e3F, 1e3F, 1e3F});
  field.normals.resize(points.size() + 1);
  return field;
}

// (m) `normals` to all points.
void spread_normals(const std::vector<Spot>& normals, const std::vector<std::uint32_t>& by,
                    Field& field) {
  for (std::size_t k = 0; k < by.size(); ++k) field.normals[k] = normals[by[k]];
}

// Neighbourhoods of multiples of four, filled up by the place that counts nothing.
void fill_up(Neighborhoods& neighborhoods, std::size_t nothing) {
  const std::size_t count = neighborhoods.reach.size();
  const std::size_t size = (neighborhoods.size + 3) / 4 * 4;
  if (size == neighborhoods.size) return;
  std::vector<std::uint32_t> indices(count * size, static_cast<std::uint32_t>(nothing));
  for (std::size_t i = 0; i < count; ++i) {
    std::ranges::copy(neighborhoods.of(i), indices.begin() + static_cast<std::ptrdiff_t>(i * size));
  }
  neighborhoods.indices = std::move(indices);
  neighborhoods.size = size;
}

// Each normal becomes the mean of those around it, turned to its side. (m)
std::vector<Spot> filter_normals(const Field& field, const Stage& stage, int threads) {
  std::vector<Spot> filtered(stage.of.size());
  const auto filter = [&](std::size_t i) {
    const Weights weights(stage.neighborhoods.reach[i] / field.unit,
                          stage.height_width / field.unit);
    const Spot& along = field.normals[stage.of[i]];
    const Lanes3 point = all_lanes(field.points[stage.of[i]]);
    const Lanes3 normal = all_lanes(along);
    Lanes3 sums{};
    const auto neighbors = stage.neighborhoods.of(i);
    for (std::size_t k = 0; k < neighbors.size(); k += 4) {
      const Lanes3 d = gather(field.points.data(), &neighbors[k]) - point;
      const Lanes3 other = gather(field.normals.data(), &neighbors[k]);
      const Lanes cosine = dot(normal, other);
      const Lanes weight = weights(dot(d, d), cosine, dot(normal, d)) * cosine;
      sums.x += weight * other.x;
      sums.y += weight * other.y;
      sums.z += weight * other.z;
    }
    const Vec3 own{along.x, along.y, along.z};
    const Vec3 all = own + Vec3{sum(sums.x), sum(sums.y), sum(sums.z)};
    filtered[i] = narrow((1.0 / norm(all)) * all);  // along its own, it is 1 at least
  };
  parallel_ranges(filtered.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) filter(i);
  });
  return filtered;
}

// Where they are after it. (m)
std::vector<Vec3> moved_points(const Field& field, const Stage& stage, int threads) {
  std::vector<Vec3> moved(stage.of.size());
  const auto move = [&](std::size_t i) {
    const Weights weights(stage.neighborhoods.reach[i] / field.unit,
                          stage.height_width / field.unit);
    const Spot& along = field.normals[stage.of[i]];
    const Lanes3 point = all_lanes(field.points[stage.of[i]]);
    const Lanes3 normal = all_lanes(along);
    Lanes total{};
    Lanes heights{};
    const auto neighbors = stage.neighborhoods.of(i);
    for (std::size_t k = 0; k < neighbors.size(); k += 4) {
      const Lanes3 d = gather(field.points.data(), &neighbors[k]) - point;
      const Lanes3 other = gather(field.normals.data(), &neighbors[k]);
      const Lanes cosine = dot(normal, other);
      const Lanes height = 0.5F * (dot(normal, d) + with_sign(dot(other, d), cosine));
      const Lanes weight = weights(dot(d, d), cosine, height);
      total += weight;
      heights += weight * height;
    }
    const double height = field.unit * (sum(heights) / (1.0F + sum(total)));
    moved[i] = stage.points[stage.of[i]] + height * Vec3{along.x, along.y, along.z};
  };
  parallel_ranges(moved.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) move(i);
  });
  return moved;
}

// (m) Where they are after a round; nothing if half of the cloud lies on planes.
std::vector<Vec3> smooth_once(Stage& stage, int threads) {
  const std::size_t inner = std::min(stage.inner, stage.points.size() - 1);
  const Planes planes = fit_planes(stage.points, stage.of, stage.neighborhoods, inner, threads);
  if (stage.height_width == 0.0) {
    stage.height_width = kHeightWidth * quantile(planes.residual, 0.5);
    if (!(stage.height_width > 0.0)) return {};
  }
  Field field = make_field(stage.points);
  fill_up(stage.neighborhoods, stage.points.size());
  std::vector<Spot> normals;
  normals.reserve(planes.normal.size());
  for (const Vec3& normal : planes.normal) normals.push_back(narrow(normal));
  spread_normals(normals, stage.by, field);
  for (int i = 0; i < kNormalRounds; ++i) {
    spread_normals(filter_normals(field, stage, threads), stage.by, field);
  }
  return moved_points(field, stage, threads);
}

// How many neighbours a point is smoothed by, and how many of them its plane is laid through.
struct Sizes {
  std::size_t all;
  std::size_t inner;

  explicit Sizes(double share)
      : all(std::max(static_cast<std::size_t>(share * kNeighbors), kLeastNeighbors)),
        inner(static_cast<std::size_t>(kPlaneShare * static_cast<double>(all))) {}
};

}  // namespace

std::vector<Vec3> smooth(const Cover& cover, int rounds, int threads) {
  std::vector<Vec3> points = cover.kept_points();
  if (rounds == 0 || points.empty()) return points;
  const bool all = points.size() == cover.points.size();
  const Sizes wide(1.0);
  Stage first{cover.points, cover.kept, cover.by, {}, wide.inner, 0.0};
  first.neighborhoods =
      find_neighborhoods_of(cover.kept, cover.points, wide.all, threads, wide.inner);
  std::vector<Vec3> moved = smooth_once(first, threads);
  if (moved.empty()) return points;
  points = std::move(moved);
  if (rounds == 1) return points;
  std::vector<std::uint32_t> own(points.size());
  std::iota(own.begin(), own.end(), 0);
  const Sizes sizes(cover.kept_share());
  Stage rest{points, own, own, {}, sizes.inner, all ? first.height_width : 0.0};
  // Neighbours are found anew once: the first round moves the points most.
  rest.neighborhoods = find_neighborhoods(points, sizes.all, threads, sizes.inner);
  for (int round = 1; round < rounds; ++round) {
    moved = smooth_once(rest, threads);
    if (moved.empty()) break;
    points = std::move(moved);
  }
  return points;
}

}  // namespace morsel
