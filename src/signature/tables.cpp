#include "signature/tables.hpp"

#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "base/threads.hpp"
#include "signature/harmonics.hpp"
#include "signature/landmarks.hpp"
#include "signature/solid.hpp"
#include "signature/tent.hpp"

namespace morsel {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kDegree = 4;
constexpr std::size_t kHarmonics = harmonic_count(kDegree);
using Coefficients = std::array<double, kHarmonics>;

constexpr std::size_t kLandmarks = 320;
constexpr std::size_t kGeodesicSources = 64;

// Square roots bring out small values and make the distance of histograms one of probabilities.
std::uint8_t root_byte(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(std::clamp(value, 0.0, 1.0))));
}
std::uint8_t signed_root_byte(double value) {
  const double root = std::sqrt(std::min(std::abs(value), 1.0));
  return static_cast<std::uint8_t>(128 + std::lround(std::copysign(127.0 * root, value)));
}

void add(Coefficients& to, double weight, const Coefficients& values) {
  for (std::size_t i = 0; i < kHarmonics; ++i) to[i] += weight * values[i];
}

// Direction from a centre as harmonics, and the distance.
double look_from(const Vec3& center, const Vec3& point, Vec3& direction, Coefficients& values) {
  const Vec3 arm = point - center;
  const double r = norm(arm);
  direction = r > 0.0 ? (1.0 / r) * arm : Vec3{0.0, 0.0, 1.0};
  evaluate_harmonics(direction, kDegree, values);
  return r;
}

Bytes energies(const std::vector<Coefficients>& bins) {
  Bytes bytes;
  for (const Coefficients& bin : bins) {
    for (std::size_t l = 0; l <= kDegree; ++l) {
      bytes.push_back(
          root_byte(harmonic_energy(bin, l) / std::sqrt(2.0 * static_cast<double>(l) + 1.0)));
    }
  }
  return bytes;
}

// Shells reach so many RMS radii.
constexpr double kReach = 2.4;

// Thickness on a logarithmic axis, relative to `unit`.
double thickness_position(double thickness, double unit, double thinnest) {
  constexpr double kThickest = 0.8;
  const double relative = std::max(thickness / unit, 1e-9);
  return std::log(relative / thinnest) / std::log(kThickest / thinnest);
}

// ---- of the surface ----

// What the surface tables share.
struct Surface {
  const std::vector<Vec3>& points;
  Frame frame;
  Landmarks landmarks;
};

// Per degree, how the harmonics of the shells lie relative to each other: the root of their Gram
// matrix. Powers alone would not notice one shell turned against the next.
Bytes shells_table(const Surface& surface) {
  constexpr std::size_t kShells = 6;
  std::vector<Coefficients> shells(kShells, Coefficients{});
  Coefficients values{};
  Vec3 direction;
  const double share = 1.0 / static_cast<double>(surface.points.size());
  for (const Vec3& p : surface.points) {
    const double r = look_from(surface.frame.centroid, p, direction, values);
    const Tent at = tent(r / (kReach * surface.frame.size), kShells);
    for (std::size_t i = 0; i < 2; ++i) add(shells[at.bin + i], share * at.share[i], values);
  }
  Bytes bytes;
  for (std::size_t l = 0; l <= kDegree; ++l) {
    Eigen::Matrix<double, kShells, kShells> gram;
    for (std::size_t a = 0; a < kShells; ++a) {
      for (std::size_t b = 0; b < kShells; ++b) {
        double sum = 0.0;
        for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i) sum += shells[a][i] * shells[b][i];
        gram(a, b) = sum / (2.0 * static_cast<double>(l) + 1.0);
      }
    }
    const Eigen::SelfAdjointEigenSolver<decltype(gram)> solver(gram);
    const auto roots = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    const Eigen::Matrix<double, kShells, kShells> root =
        solver.eigenvectors() * roots.asDiagonal() * solver.eigenvectors().transpose();
    for (std::size_t a = 0; a < kShells; ++a) {
      for (std::size_t b = a; b < kShells; ++b) bytes.push_back(signed_root_byte(root(a, b)));
    }
  }
  return bytes;
}

// Thickness below a point × how the surface faces the centre × shell × degree.
Bytes facing_table(const Surface& surface, const Solid& solid) {
  constexpr std::size_t kBands = 4;
  constexpr std::size_t kAngles = 3;
  constexpr std::size_t kFineShells = 6;  // added up in pairs
  std::vector<Coefficients> bins(kBands * kAngles * kFineShells / 2, Coefficients{});
  Coefficients values{};
  Vec3 direction;
  const double share = 1.0 / static_cast<double>(surface.points.size());
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const double r = look_from(surface.frame.centroid, surface.points[i], direction, values);
    const Vec3& normal = surface.landmarks.normal[surface.landmarks.owner[i]];
    const Tent band = tent(
        thickness_position(solid.vertex_thickness[i], surface.frame.size, 0.02), kBands);
    const Tent angle = tent(std::abs(dot(direction, normal)), kAngles);
    const Tent shell = tent(r / (kReach * surface.frame.size), kFineShells);
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t t = k & 1U;
      const std::size_t u = k >> 1U & 1U;
      const std::size_t s = k >> 2U;
      const std::size_t bin =
          ((band.bin + t) * kAngles + angle.bin + u) * (kFineShells / 2) + (shell.bin + s) / 2;
      add(bins[bin], share * band.share[t] * angle.share[u] * shell.share[s], values);
    }
  }
  return energies(bins);
}

// Pairs of landmarks: distance × the angles of both normals with the line between × with each other.
// Source: E. Wahl, U. Hillenbrand, G. Hirzinger, "Surflet-Pair-Relation Histograms", 3DIM 2003.
// Differs: normals have no sign; landmarks instead of random pairs.
Bytes pairs_table(const Surface& surface) {
  constexpr std::size_t kDistances = 8;
  constexpr std::size_t kAngles = 3;
  constexpr std::size_t kTilts[kAngles][kAngles] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  constexpr double kFarthest = 3.6;  // RMS radii
  std::vector<double> bins(kDistances * 6 * kAngles, 0.0);
  const Landmarks& marks = surface.landmarks;
  for (std::size_t a = 0; a < marks.count(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const Vec3 arm = marks.position[a] - marks.position[b];
      const double length = norm(arm);
      if (!(length > 0.0)) continue;
      const Tent at = tent(length / (kFarthest * surface.frame.size), kDistances);
      const Tent tilt_a = tent(std::abs(dot(marks.normal[a], arm)) / length, kAngles);
      const Tent tilt_b = tent(std::abs(dot(marks.normal[b], arm)) / length, kAngles);
      const Tent bend = tent(std::abs(dot(marks.normal[a], marks.normal[b])), kAngles);
      for (std::size_t k = 0; k < 16; ++k) {
        const std::size_t d = k & 1U;
        const std::size_t i = k >> 1U & 1U;
        const std::size_t j = k >> 2U & 1U;
        const std::size_t n = k >> 3U;
        const std::size_t tilt = kTilts[tilt_a.bin + i][tilt_b.bin + j];
        bins[((at.bin + d) * 6 + tilt) * kAngles + bend.bin + n] +=
            2.0 * marks.weight[a] * marks.weight[b] * at.share[d] * tilt_a.share[i] *
            tilt_b.share[j] * bend.share[n];
      }
    }
  }
  Bytes bytes;
  for (const double bin : bins) bytes.push_back(root_byte(bin));
  return bytes;
}

// ---- of the inside ----

constexpr double kThinnestInside = 0.03;

// Thickness × shell × degree, by volume.
Bytes thickness_table(const Solid& solid) {
  constexpr std::size_t kBands = 4;
  constexpr std::size_t kShells = 6;
  std::vector<Coefficients> bins(kBands * kShells, Coefficients{});
  Coefficients values{};
  Vec3 direction;
  const double side = std::cbrt(solid.volume);
  for (const Solid::Cell& cell : solid.cells) {
    const double r = look_from(solid.frame.centroid, cell.centroid, direction, values);
    const Tent band = tent(thickness_position(cell.thickness, side, kThinnestInside), kBands);
    const Tent shell = tent(r / (kReach * solid.frame.size), kShells);
    for (std::size_t k = 0; k < 4; ++k) {
      const double weight = cell.share * band.share[k & 1U] * shell.share[k >> 1U];
      add(bins[(band.bin + (k & 1U)) * kShells + shell.bin + (k >> 1U)], weight, values);
    }
  }
  return energies(bins);
}

// Landmarks joined where an inner edge leads from one's points to the other's.
using Roads = std::vector<std::vector<std::pair<std::uint32_t, double>>>;

Roads find_roads(const DelaunayComplex& complex, const Solid& solid, const Landmarks& marks) {
  std::vector<bool> joined(marks.count() * marks.count(), false);
  for (const Solid::Cell& cell : solid.cells) {
    for (const std::uint32_t v : complex.cells[cell.cell]) {
      for (const std::uint32_t w : complex.cells[cell.cell]) {
        joined[marks.owner[v] * marks.count() + marks.owner[w]] = true;
      }
    }
  }
  Roads roads(marks.count());
  for (std::uint32_t a = 0; a < marks.count(); ++a) {
    for (std::uint32_t b = 0; b < marks.count(); ++b) {
      if (a == b || !joined[a * marks.count() + b]) continue;
      roads[a].emplace_back(b, distance(marks.position[a], marks.position[b]));
    }
  }
  return roads;
}

// Shortest ways from one landmark to all others (E. W. Dijkstra 1959); infinite where there is none.
std::vector<double> shortest_ways(const Roads& roads, std::uint32_t from) {
  std::vector<double> length(roads.size(), std::numeric_limits<double>::infinity());
  using Step = std::pair<double, std::uint32_t>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
  length[from] = 0.0;
  open.emplace(0.0, from);
  while (!open.empty()) {
    const auto [way, at] = open.top();
    open.pop();
    if (way > length[at]) continue;
    for (const auto& [next, step] : roads[at]) {
      if (way + step >= length[next]) continue;
      length[next] = way + step;
      open.emplace(length[next], next);
    }
  }
  return length;
}

std::vector<double> shares_of_landmarks(const Solid& solid, const Landmarks& marks) {
  std::vector<double> shares(marks.count(), 0.0);
  for (std::size_t v = 0; v < marks.owner.size(); ++v) {
    shares[marks.owner[v]] += solid.vertex_share[v];
  }
  return shares;
}

// The first landmarks stand for the volume around them; each of the others adds to the nearest.
std::vector<double> gather_shares(const Landmarks& marks, const std::vector<double>& shares,
                                  std::size_t sources) {
  std::vector<double> gathered(sources, 0.0);
  for (std::size_t k = 0; k < marks.count(); ++k) {
    std::size_t nearest = 0;
    for (std::size_t s = 1; s < sources; ++s) {
      if (squared_distance(marks.position[k], marks.position[s]) <
          squared_distance(marks.position[k], marks.position[nearest])) {
        nearest = s;
      }
    }
    gathered[nearest] += shares[k];
  }
  return gathered;
}

// Each landmark's mean way through the inside to the volume, over the mean of all.
std::vector<double> find_centricity(const DelaunayComplex& complex, const Solid& solid,
                                    const Landmarks& marks) {
  const Roads roads = find_roads(complex, solid, marks);
  const std::vector<double> shares = shares_of_landmarks(solid, marks);
  const std::size_t sources = std::min(kGeodesicSources, marks.count());
  const std::vector<double> weights = gather_shares(marks, shares, sources);
  std::vector<std::vector<double>> ways;
  double longest = 0.0;
  for (std::uint32_t s = 0; s < sources; ++s) {
    ways.push_back(shortest_ways(roads, s));
    for (const double way : ways[s]) {
      if (std::isfinite(way)) longest = std::max(longest, way);
    }
  }
  std::vector<double> centricity(marks.count(), 0.0);
  double mean = 0.0;
  for (std::size_t k = 0; k < marks.count(); ++k) {
    for (std::size_t s = 0; s < sources; ++s) {
      // Between objects that do not touch there is no way: farther than all that there are.
      const double way = std::isfinite(ways[s][k])
                             ? ways[s][k]
                             : longest + distance(marks.position[s], marks.position[k]);
      centricity[k] += weights[s] * way;
    }
    mean += shares[k] * centricity[k];
  }
  for (double& value : centricity) value /= mean;
  return centricity;
}

// Thickness × centricity, by volume.
Bytes centricity_table(const DelaunayComplex& complex, const Surface& surface,
                       const Solid& solid) {
  constexpr std::size_t kBands = 12;
  constexpr std::size_t kFineRings = 12;  // added up in pairs
  std::vector<double> bins(kBands * kFineRings / 2, 0.0);
  const std::vector<double> centricity = find_centricity(complex, solid, surface.landmarks);
  const double side = std::cbrt(solid.volume);
  for (std::size_t v = 0; v < complex.vertices.size(); ++v) {
    if (!(solid.vertex_share[v] > 0.0)) continue;
    const Tent band =
        tent(thickness_position(solid.vertex_thickness[v], side, kThinnestInside), kBands);
    const Tent ring = tent((centricity[surface.landmarks.owner[v]] - 0.55) / 1.2, kFineRings);
    for (std::size_t k = 0; k < 4; ++k) {
      bins[(band.bin + (k & 1U)) * (kFineRings / 2) + (ring.bin + (k >> 1U)) / 2] +=
          solid.vertex_share[v] * band.share[k & 1U] * ring.share[k >> 1U];
    }
  }
  Bytes bytes;
  for (const double bin : bins) bytes.push_back(root_byte(bin));
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> make_tables(const DelaunayComplex& complex, const Basins& basins,
                                      int threads) {
  Solid solid;
  Surface surface{.points = complex.vertices, .frame = frame_of_points(complex.vertices),
                  .landmarks = {}};
  std::array<Bytes, kTableBlocks.size()> blocks;
  const auto invoke = [threads](const auto& a, const auto& b) {
    if (resolve_threads(threads) == 1) {
      a();
      b();
    } else {
      tbb::task_arena(2).execute([&] { tbb::parallel_invoke(a, b); });
    }
  };
  invoke([&] { solid = find_solid(complex, basins); },
         [&] {
           surface.landmarks =
               find_landmarks(complex.vertices, surface.frame.centroid, kLandmarks);
         });
  const bool inside = solid.volume > 0.0;
  invoke(
      [&] {
        blocks[0] = shells_table(surface);
        blocks[1] = facing_table(surface, solid);
      },
      [&] {
        blocks[2] = pairs_table(surface);
        if (!inside) return;
        blocks[3] = thickness_table(solid);
        blocks[4] = centricity_table(complex, surface, solid);
      });
  Bytes tables{static_cast<std::uint8_t>(std::lround(255.0 * solid.solidity))};
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].resize(kTableBlocks[i].size, 0);
    tables.insert(tables.end(), blocks[i].begin(), blocks[i].end());
  }
  return tables;
}

}  // namespace morsel
