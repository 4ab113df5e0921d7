// Sources:
//   H. Pfister, M. Zwicker, J. van Baar, M. Gross, "Surfels: surface elements as rendering
//     primitives", SIGGRAPH 2000.
//   H. Hoppe et al., "Surface reconstruction from unorganized points", SIGGRAPH 1992: normals by
//     principal component analysis of the nearest neighbours.
#include "picture/surfels.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nanoflann.hpp>

#include "base/box.hpp"
#include "base/morton.hpp"
#include "base/threads.hpp"

namespace morsel::picture {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

constexpr std::size_t kNeighbors = 16;
// Noisy clouds are first smoothed over as few of these numbers of neighbours as span planes.
constexpr std::array<std::size_t, 3> kSmoothingNeighbors{32, 64, 128};
constexpr float kFlat = 0.4F;  // thickness of such a plane by its width
constexpr int kSmoothingRounds = 2;
constexpr std::size_t kEnoughPoints = 3000;  // to tell whether a cloud is noisy
constexpr std::size_t kMostNoisyPoints = 50'000;
constexpr std::size_t kNoisyNeighbors = 40;  // that give the normals afterwards
constexpr int kNormalRounds = 3;
constexpr float kSameSide = 0.55F;  // least agreement of normals on one side of a bend
constexpr float kLimb = 0.55F;      // thickness by width of neighbourhoods that wrap around a limb
constexpr float kCrease = 0.12F;    // thickness by reach of neighbourhoods that straddle a crease
// A cloud is noisy when its points stray further than this from their planes, as a share of the
// distance to the last of kNeighbors: more than curved but exact samples do.
constexpr float kNoisy = 0.13F;
// Fewer points than this do not make a surface and are drawn as balls.
constexpr std::size_t kFewPoints = 400;
// Disc radius as a share of the distance to the last neighbour: closes randomly sampled surfaces.
constexpr float kCoverage = 0.72F;
// Points whose neighbours are this many times further than usual are isolated.
constexpr float kIsolation = 8.0F;

template <typename Body>
void parallel_for_each(std::size_t count, const Body& body) {
  parallel_ranges(count, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

std::uint64_t cell_code(const Vector3f& p, float cell) {
  const auto coordinate = [cell](float x) {
    return spread_bits(static_cast<std::uint64_t>(std::max(0.0F, (x + 1.0F) / cell)));
  };
  return coordinate(p.x()) | coordinate(p.y()) << 1 | coordinate(p.z()) << 2;
}

struct CellEntry {
  std::uint64_t code;
  int label;
  std::uint32_t index;

  bool operator<(const CellEntry& other) const {
    if (code != other.code) return code < other.code;
    if (label != other.label) return label < other.label;
    return index < other.index;
  }
};

// The longest run of one label among the entries of one cell; the first of equals.
std::span<const CellEntry> commonest_label(std::span<const CellEntry> cell) {
  std::span<const CellEntry> best;
  for (std::size_t begin = 0; begin < cell.size();) {
    std::size_t end = begin;
    while (end < cell.size() && cell[end].label == cell[begin].label) ++end;
    if (end - begin > best.size()) best = cell.subspan(begin, end - begin);
    begin = end;
  }
  return best;
}

struct CloudAdaptor {
  const std::vector<Vector3f>& points;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <typename Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, CloudAdaptor>,
                                        CloudAdaptor, 3, std::uint32_t>;

// The neighbours of every point, itself included, nearest first.
struct Neighborhoods {
  std::size_t count = 0;  // neighbours of each point
  std::vector<std::uint32_t> index;
  std::vector<float> reach;  // distance to neighbour kNeighbors

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t i) const {
    return {index.data() + i * count, count};
  }
};

// Of every `stride`-th point.
Neighborhoods find_neighborhoods(const std::vector<Vector3f>& points, std::size_t count,
                                 std::size_t stride = 1) {
  const std::size_t queries = (points.size() + stride - 1) / stride;
  Neighborhoods result;
  result.count = std::min(count, points.size());
  result.index.resize(queries * result.count);
  result.reach.resize(queries);
  const CloudAdaptor adaptor{points};
  const KdTree tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(12));
  parallel_for_each(queries, [&](std::size_t i) {
    std::array<float, kSmoothingNeighbors.back()> squared{};
    tree.knnSearch(points[i * stride].data(), result.count, &result.index[i * result.count],
                   squared.data());
    result.reach[i] = std::sqrt(squared[std::min(kNeighbors, result.count) - 1]);
  });
  return result;
}

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Mean and principal axes of a neighbourhood; spreads are standard deviations, largest first.
struct LocalFit {
  Vector3f mean;
  Vector3f spread;
  Matrix3f axes;  // columns, in the order of `spread`
};

LocalFit fit(const std::vector<Vector3f>& points, std::span<const std::uint32_t> neighbors) {
  // About the nearest point, which keeps the sums small.
  const Vector3f origin = points[neighbors.front()];
  const float share = 1.0F / static_cast<float>(neighbors.size());
  Vector3f mean = Vector3f::Zero();
  Vector3f squares = Vector3f::Zero();
  Vector3f mixed = Vector3f::Zero();  // yz, zx, xy
  for (const std::uint32_t j : neighbors) {
    const Vector3f d = points[j] - origin;
    mean += share * d;
    squares += share * d.cwiseProduct(d);
    mixed += share * Vector3f(d.y() * d.z(), d.z() * d.x(), d.x() * d.y());
  }
  squares -= mean.cwiseProduct(mean);
  mixed -= Vector3f(mean.y() * mean.z(), mean.z() * mean.x(), mean.x() * mean.y());
  Matrix3f covariance;
  covariance << squares.x(), mixed.z(), mixed.y(),  //
      mixed.z(), squares.y(), mixed.x(),            //
      mixed.y(), mixed.x(), squares.z();
  Eigen::SelfAdjointEigenSolver<Matrix3f> solver;
  solver.computeDirect(covariance);
  return {origin + mean, solver.eigenvalues().reverse().cwiseMax(0.0F).cwiseSqrt(),
          solver.eigenvectors().rowwise().reverse()};
}

// On thin limbs the neighbours wrap around the limb and span no plane; there the surface faces
// away from the neighbours' mean.
Vector3f limb_normal(const Vector3f& point, const LocalFit& fit) {
  const Vector3f along = fit.axes.col(0);
  Vector3f away = point - fit.mean;
  away -= along.dot(away) * along;
  return away.norm() > 0.3F * fit.spread[1] ? Vector3f(away.normalized())
                                            : Vector3f(fit.axes.col(2));
}

// The normal at point i. A neighbourhood that straddles a crease gives a slanted one; there the
// plane of the flattest neighbour that passes through the point is right.
Vector3f surface_normal(const std::vector<Vector3f>& points,
                        std::span<const std::uint32_t> neighbors, const std::vector<LocalFit>& fits,
                        float reach, std::size_t i) {
  const Vector3f& spread = fits[i].spread;
  const bool limb = spread[2] > kLimb * spread[1] && spread[1] < 0.8F * spread[0];
  if (limb) return limb_normal(points[i], fits[i]);
  const LocalFit* best = &fits[i];
  if (best->spread[2] < kCrease * reach) return best->axes.col(2);
  float least = 0.5F * best->spread[2];
  for (const std::uint32_t j : neighbors) {
    const Vector3f normal = fits[j].axes.col(2);
    const float distance = std::abs(normal.dot(points[i] - fits[j].mean));
    if (fits[j].spread[2] >= least || distance > 0.05F * reach + fits[j].spread[2]) continue;
    least = fits[j].spread[2];
    best = &fits[j];
  }
  return best->axes.col(2);
}

std::vector<LocalFit> fit_all(const std::vector<Vector3f>& points,
                              const Neighborhoods& neighborhoods) {
  std::vector<LocalFit> fits(neighborhoods.reach.size());
  parallel_for_each(fits.size(),
                    [&](std::size_t i) { fits[i] = fit(points, neighborhoods.of(i)); });
  return fits;
}

// The fit to the fewest neighbours that span a plane despite the noise.
LocalFit smoothing_fit(const std::vector<Vector3f>& points,
                       std::span<const std::uint32_t> neighbors) {
  LocalFit result;
  for (const std::size_t count : kSmoothingNeighbors) {
    result = fit(points, neighbors.first(std::min(count, neighbors.size())));
    if (result.spread[2] < kFlat * result.spread[1]) break;
  }
  return result;
}

// Projects the points onto planes fitted to wide neighbourhoods, a few times. Where neighbours
// wrap around a limb there is no plane, and points stay.
Cloud smooth(Cloud cloud) {
  std::vector<Vector3f>& points = cloud.points;
  const Neighborhoods neighborhoods = find_neighborhoods(points, kSmoothingNeighbors.back());
  for (int round = 0; round < kSmoothingRounds; ++round) {
    std::vector<Vector3f> moved(points.size());
    parallel_for_each(points.size(), [&](std::size_t i) {
      const LocalFit plane = smoothing_fit(points, neighborhoods.of(i));
      const Vector3f normal = plane.axes.col(2);
      const float thickness = plane.spread[2] / (plane.spread[1] + 1e-9F);
      const float share = std::clamp((0.85F - thickness) / 0.4F, 0.0F, 1.0F);
      moved[i] = points[i] - share * normal.dot(points[i] - plane.mean) * normal;
    });
    points = std::move(moved);
  }
  return cloud;
}

// Merges points until smoothing is affordable: detail finer than the noise is not lost by it.
Cloud thin_out(Cloud cloud, float usual_reach) {
  float cell = 0.25F * usual_reach;
  while (cloud.points.size() > kMostNoisyPoints) {
    cell *= 1.4F;
    cloud = merge_on_grid(cloud, cell);
  }
  return cloud;
}

// Smooths a noisy cloud; returns whether it was. A few thousand points tell.
bool smooth_if_noisy(Cloud& cloud) {
  const std::size_t stride = cloud.points.size() / kEnoughPoints + 1;
  const Neighborhoods sample = find_neighborhoods(cloud.points, kNeighbors, stride);
  std::vector<float> strays;
  for (const LocalFit& fit : fit_all(cloud.points, sample)) {
    strays.push_back(fit.spread[2] / (sample.reach[strays.size()] + 1e-9F));
  }
  if (median(std::move(strays)) <= kNoisy) return false;
  cloud = smooth(thin_out(std::move(cloud), median(sample.reach)));
  return true;
}

// How much two unit normals of unknown sign belong to one smooth piece of surface.
float agreement(const Vector3f& a, const Vector3f& b) {
  const float cosine = a.dot(b);
  const float square = cosine * cosine;
  return square * square * square * square;
}

// Averages each normal with those of its neighbours that point about the same way: calms noise,
// keeps creases.
// Source: S. Fleishman, I. Drori, D. Cohen-Or, "Bilateral mesh denoising", SIGGRAPH 2003.
// Differs: on points, and over normals.
std::vector<Vector3f> smooth_normals(const std::vector<Vector3f>& normals,
                                     const Neighborhoods& neighborhoods) {
  std::vector<Vector3f> smooth(normals.size());
  parallel_for_each(normals.size(), [&](std::size_t i) {
    Vector3f sum = Vector3f::Zero();
    for (const std::uint32_t j : neighborhoods.of(i)) {
      const float sign = normals[i].dot(normals[j]) < 0.0F ? -1.0F : 1.0F;
      sum += sign * agreement(normals[i], normals[j]) * normals[j];
    }
    smooth[i] = sum.normalized();
  });
  return smooth;
}

// The mean of the neighbours on the same side of any crease.
Vector3f mean_of_side(const std::vector<Vector3f>& points, const std::vector<Vector3f>& normals,
                      std::span<const std::uint32_t> neighbors, std::size_t i) {
  Vector3f sum = points[i];
  float weight = 1.0F;
  for (const std::uint32_t j : neighbors) {
    const float share = agreement(normals[i], normals[j]);
    sum += share * points[j];
    weight += share;
  }
  return sum / weight;
}

// Where the surface ends (the rim of an open sheet) a surfel is cut off with its last neighbour,
// else it would stick out by its radius.
Clip rim_clip(const Surfel& surfel, const std::vector<Vector3f>& points,
              std::span<const std::uint32_t> neighbors, const Vector3f& mean, float reach) {
  Vector3f away = surfel.position - mean;
  away -= surfel.normal.dot(away) * surfel.normal;
  if (away.norm() < 0.1F * reach) return {};
  Clip clip{away.normalized(), 0.0F};
  for (const std::uint32_t j : neighbors) {
    clip.reach = std::max(clip.reach, clip.outward.dot(points[j] - surfel.position));
  }
  clip.reach += 0.03F * reach;
  return clip;
}

// Where the surface bends, the planes of the nearest neighbours beyond the bend, one on either
// side, cut off what would stick out of a convex edge or into a concave one.
void set_clips(Surfel& surfel, const std::vector<Vector3f>& points,
               const std::vector<Vector3f>& normals, std::span<const std::uint32_t> neighbors,
               const Vector3f& mean, float reach) {
  std::size_t count = 0;
  for (const std::uint32_t j : neighbors) {
    if (count == surfel.clips.size()) break;
    if (agreement(surfel.normal, normals[j]) > kSameSide) continue;
    // The surfel's side of the plane is its neighbours' side.
    const float side = normals[j].dot(mean - points[j]) < 0.0F ? 1.0F : -1.0F;
    const Vector3f outward = side * normals[j];
    if (count == 1 && outward.dot(surfel.clips[0].outward) > 0.5F) continue;
    const float distance = outward.dot(points[j] - surfel.position);
    surfel.clips[count++] = {outward, std::max(0.0F, distance) + 0.03F * reach};
  }
  if (count == 0) surfel.clips[0] = rim_clip(surfel, points, neighbors, mean, reach);
}

void set_axes(Surfel& surfel, const LocalFit& fit, float reach) {
  // A disc of radius r has spread r / 2, so twice the spread gives discs on plain surfaces and
  // ellipses along thin limbs.
  const float longest = kCoverage * reach;
  const float a = std::clamp(2.2F * kCoverage * fit.spread[0], 0.6F * longest, longest);
  const float b = std::clamp(2.2F * kCoverage * fit.spread[1], 0.25F * longest, longest);
  Vector3f major = fit.axes.col(0) - surfel.normal.dot(fit.axes.col(0)) * surfel.normal;
  if (major.norm() < 1e-3F) major = surfel.normal.unitOrthogonal();
  surfel.major = a * major.normalized();
  surfel.minor = b * surfel.normal.cross(major.normalized());
}

void make_ball(Surfel& surfel, float radius) {
  surfel.ball = true;
  surfel.normal = Vector3f::UnitZ();
  surfel.major = radius * Vector3f::UnitX();
  surfel.minor = radius * Vector3f::UnitY();
  surfel.clips = {};
}

std::vector<Surfel> make_balls(const Cloud& cloud) {
  const std::size_t n = cloud.points.size();
  // The balls of n points spread over a unit sphere would just touch at about 1.8 / sqrt(n).
  const float radius = std::min(0.2F, 0.9F / std::sqrt(static_cast<float>(n)));
  std::vector<Surfel> surfels(n);
  for (std::size_t i = 0; i < n; ++i) {
    surfels[i].position = cloud.points[i];
    surfels[i].label = cloud.labels[i];
    make_ball(surfels[i], radius);
  }
  return surfels;
}

}  // namespace

Cloud normalize(std::span<const Vec3> points, std::span<const int> labels) {
  const Box box = bounding_box(points);
  // Halved before the sum or difference, which could overflow.
  const Vec3 center = 0.5 * box.low + 0.5 * box.high;
  const Vec3 half = 0.5 * box.high - 0.5 * box.low;
  const double longest = std::max({half.x, half.y, half.z});
  const double divisor = longest > 0.0 ? longest : 1.0;
  Cloud cloud{{}, {}, center, divisor};
  cloud.points.reserve(points.size());
  cloud.labels.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) continue;
    const Vec3 p = points[i] - center;
    cloud.points.emplace_back(static_cast<float>(p.x / divisor), static_cast<float>(p.y / divisor),
                              static_cast<float>(p.z / divisor));
    cloud.labels.push_back(labels[i]);
  }
  return cloud;
}

Cloud merge_on_grid(const Cloud& cloud, float cell) {
  std::vector<CellEntry> entries(cloud.points.size());
  parallel_for_each(entries.size(), [&](std::size_t i) {
    entries[i] = {cell_code(cloud.points[i], cell), cloud.labels[i], static_cast<std::uint32_t>(i)};
  });
  parallel_sort(entries, 0);
  Cloud merged{{}, {}, cloud.center, cloud.scale};
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin;
    while (end < entries.size() && entries[end].code == entries[begin].code) ++end;
    const auto kept = commonest_label(std::span(entries).subspan(begin, end - begin));
    Vector3f sum = Vector3f::Zero();
    for (const CellEntry& entry : kept) sum += cloud.points[entry.index];
    merged.points.emplace_back(sum / static_cast<float>(kept.size()));
    merged.labels.push_back(kept.front().label);
    begin = end;
  }
  return merged;
}

std::vector<Surfel> make_surfels(const Cloud& input) {
  if (input.points.size() < kFewPoints) return make_balls(input);
  Cloud cloud = input;
  const bool noisy = smooth_if_noisy(cloud);
  const Neighborhoods neighborhoods =
      find_neighborhoods(cloud.points, noisy ? kNoisyNeighbors : kNeighbors);
  const std::vector<LocalFit> fits = fit_all(cloud.points, neighborhoods);
  const std::vector<Vector3f>& points = cloud.points;
  const std::size_t n = points.size();
  std::vector<Vector3f> normals(n);
  parallel_for_each(n, [&](std::size_t i) {
    normals[i] = surface_normal(points, neighborhoods.of(i), fits, neighborhoods.reach[i], i);
  });
  for (int round = 0; round < kNormalRounds; ++round) {
    normals = smooth_normals(normals, neighborhoods);
  }

  const float usual_reach = median(neighborhoods.reach);
  std::vector<Surfel> surfels(n);
  parallel_for_each(n, [&](std::size_t i) {
    Surfel& surfel = surfels[i];
    const float reach = neighborhoods.reach[i];
    surfel.label = cloud.labels[i];
    surfel.normal = normals[i];
    const Vector3f mean = mean_of_side(points, normals, neighborhoods.of(i), i);
    surfel.position = points[i] - normals[i].dot(points[i] - mean) * normals[i];
    set_axes(surfel, fits[i], reach);
    set_clips(surfel, points, normals, neighborhoods.of(i), mean, reach);
    surfel.isolated = reach > kIsolation * usual_reach;
    if (surfel.isolated) make_ball(surfel, 0.5F * usual_reach);
  });
  return surfels;
}

}  // namespace morsel::picture
