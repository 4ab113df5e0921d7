#include "denoise/smooth.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
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
constexpr std::size_t kPlaneNeighbors = 24;
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

// The cloud about its middle in units of its size, as floats: they hold it to a hundred thousandth
// of the spacing, and nothing overflows. One place more, far from all others and without a normal,
// counts nothing and fills up neighbourhoods.
struct Field {
  std::vector<Spot> points;   // (n + 1)
  std::vector<Spot> normals;  // (n + 1)
  double unit;
  double height_width;  // tells noise from another sheet
};

Field make_field(const std::vector<Vec3>& points, const std::vector<Vec3>& normals,
                 double height_width) {
  const Box box = bounding_box(points);
  const Vec3 middle = 0.5 * (box.low + box.high);
  Field field{{}, {}, box.longest_side(), height_width};
  field.points.reserve(points.size() + 1);
  field.normals.reserve(points.size() + 1);
  for (const Vec3& p : points) field.points.push_back(narrow((1.0 / field.unit) * (p - middle)));
  for (const Vec3& normal : normals) field.normals.push_back(narrow(normal));
  field.points.push_back({1e3F, 1e3F, 1e3F});
  field.normals.push_back({});
  return field;
}

// Neighbourhoods of multiples of four, filled up by the place that counts nothing.
void fill_up(Neighborhoods& neighborhoods) {
  const std::size_t count = neighborhoods.reach.size();
  const std::size_t size = (neighborhoods.size + 3) / 4 * 4;
  if (size == neighborhoods.size) return;
  std::vector<std::uint32_t> indices(count * size, static_cast<std::uint32_t>(count));
  for (std::size_t i = 0; i < count; ++i) {
    std::ranges::copy(neighborhoods.of(i), indices.begin() + static_cast<std::ptrdiff_t>(i * size));
  }
  neighborhoods.indices = std::move(indices);
  neighborhoods.size = size;
}

// Each normal becomes the mean of those around it, turned to its side.
std::vector<Spot> filter_normals(const Field& field, const Neighborhoods& neighborhoods,
                                 int threads) {
  std::vector<Spot> filtered(field.normals.size());
  const auto filter = [&](std::size_t i) {
    const Weights weights(neighborhoods.reach[i] / field.unit, field.height_width / field.unit);
    const Lanes3 point = all_lanes(field.points[i]);
    const Lanes3 normal = all_lanes(field.normals[i]);
    Lanes3 sums{};
    const auto neighbors = neighborhoods.of(i);
    for (std::size_t k = 0; k < neighbors.size(); k += 4) {
      const Lanes3 d = gather(field.points.data(), &neighbors[k]) - point;
      const Lanes3 other = gather(field.normals.data(), &neighbors[k]);
      const Lanes cosine = dot(normal, other);
      const Lanes weight = weights(dot(d, d), cosine, dot(normal, d)) * cosine;
      sums.x += weight * other.x;
      sums.y += weight * other.y;
      sums.z += weight * other.z;
    }
    const Vec3 own{field.normals[i].x, field.normals[i].y, field.normals[i].z};
    const Vec3 all = own + Vec3{sum(sums.x), sum(sums.y), sum(sums.z)};
    filtered[i] = narrow((1.0 / norm(all)) * all);  // along its own, it is 1 at least
  };
  parallel_ranges(neighborhoods.reach.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) filter(i);
  });
  return filtered;
}

void move_points(const Field& field, const Neighborhoods& neighborhoods, int threads,
                 std::vector<Vec3>& points) {
  const auto move = [&](std::size_t i) {
    const Weights weights(neighborhoods.reach[i] / field.unit, field.height_width / field.unit);
    const Lanes3 point = all_lanes(field.points[i]);
    const Lanes3 normal = all_lanes(field.normals[i]);
    Lanes total{};
    Lanes heights{};
    const auto neighbors = neighborhoods.of(i);
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
    const Spot& along = field.normals[i];
    points[i] = points[i] + height * Vec3{along.x, along.y, along.z};
  };
  parallel_ranges(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) move(i);
  });
}

}  // namespace

void smooth(std::vector<Vec3>& points, int rounds, int threads) {
  if (points.empty()) return;
  Neighborhoods neighborhoods;
  double height_width = 0.0;
  for (int round = 0; round < rounds; ++round) {
    // Neighbours are found anew once: the first round moves the points most.
    if (round < 2) {
      neighborhoods = find_neighborhoods(points, kNeighbors, threads, kPlaneNeighbors);
    }
    const Planes planes =
        fit_planes(points, neighborhoods, std::min(kPlaneNeighbors, points.size() - 1), threads);
    if (round == 0) height_width = kHeightWidth * quantile(planes.residual, 0.5);
    if (!(height_width > 0.0)) return;  // half of the cloud lies on planes
    fill_up(neighborhoods);
    Field field = make_field(points, planes.normal, height_width);
    for (int i = 0; i < kNormalRounds; ++i) {
      field.normals = filter_normals(field, neighborhoods, threads);
    }
    move_points(field, neighborhoods, threads, points);
  }
}

}  // namespace morsel
