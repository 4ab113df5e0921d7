#include "signature/tables.hpp"

#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <utility>

#include "base/shortest_ways.hpp"
#include "base/threads.hpp"
#include "signature/harmonics.hpp"
#include "signature/landmarks.hpp"
#include "signature/solid.hpp"
#include "signature/tent.hpp"

namespace morsel {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kDegree = 4;
using Coefficients = Harmonics<kDegree>::Values;

constexpr std::size_t kLandmarks = 320;
constexpr std::size_t kPointsPerLandmark = 6;  // at least, for a plane through them
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
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += weight * values[i];
}

// A place as seen from a centre.
struct Look {
  double distance = 0.0;
  Vec3 direction{0.0, 0.0, 1.0};
  Coefficients harmonics{};
};

void look(const Harmonics<kDegree>& harmonics, const Vec3& arm, Look& to) {
  to.distance = norm(arm);
  to.direction = to.distance > 0.0 ? (1.0 / to.distance) * arm : Vec3{0.0, 0.0, 1.0};
  harmonics.evaluate(to.direction, to.harmonics);
}

Bytes energies(const std::vector<Coefficients>& bins) {
  Bytes bytes;
  for (const Coefficients& bin : bins) {
    for (std::size_t l = 0; l <= kDegree; ++l) {
      bytes.push_back(root_byte(
          std::sqrt(harmonic_product(bin, bin, l) / (2.0 * static_cast<double>(l) + 1.0))));
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

// Sums of harmonics over the points, by shell and by thickness × facing × shell.
struct SurfaceSums {
  static constexpr std::size_t kShells = 6;
  static constexpr std::size_t kBands = 4;
  static constexpr std::size_t kAngles = 3;
  static constexpr std::size_t kWideShells = kShells / 2;

  std::vector<Coefficients> shells = std::vector<Coefficients>(kShells, Coefficients{});
  std::vector<Coefficients> facing =
      std::vector<Coefficients>(kBands * kAngles * kWideShells, Coefficients{});
};

SurfaceSums sum_surface(const Surface& surface, const Solid& solid) {
  using S = SurfaceSums;
  SurfaceSums sums;
  const Harmonics<kDegree> harmonics;
  Look to;
  const double share = 1.0 / static_cast<double>(surface.points.size());
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    look(harmonics, surface.points[i] - surface.frame.centroid, to);
    const Vec3& normal = surface.landmarks.normal[surface.landmarks.owner[i]];
    const Tent shell = tent(to.distance / (kReach * surface.frame.size), S::kShells);
    const Tent angle = tent(std::abs(dot(to.direction, normal)), S::kAngles);
    const Tent band =
        tent(thickness_position(solid.vertex_thickness[i], surface.frame.size, 0.02), S::kBands);
    for (std::size_t s = 0; s < 2; ++s) {
      add(sums.shells[shell.bin + s], share * shell.share[s], to.harmonics);
    }
    // Shells are added up in pairs, so that both may fall into one.
    const std::size_t near = shell.bin / 2;
    const std::size_t far = (shell.bin + 1) / 2;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t bin =
          ((band.bin + (k & 1U)) * S::kAngles + angle.bin + (k >> 1U)) * S::kWideShells;
      const double weight = share * band.share[k & 1U] * angle.share[k >> 1U];
      if (near == far) {
        add(sums.facing[bin + near], weight, to.harmonics);
      } else {
        add(sums.facing[bin + near], weight * shell.share[0], to.harmonics);
        add(sums.facing[bin + far], weight * shell.share[1], to.harmonics);
      }
    }
  }
  return sums;
}

// Per degree, how the harmonics of the shells lie relative to each other: the root of their Gram
// matrix. Powers alone would not notice one shell turned against the next.
Bytes shells_table(const std::vector<Coefficients>& shells) {
  using Matrix = Eigen::Matrix<double, SurfaceSums::kShells, SurfaceSums::kShells>;
  Bytes bytes;
  for (std::size_t l = 0; l <= kDegree; ++l) {
    Matrix gram;
    for (std::size_t a = 0; a < SurfaceSums::kShells; ++a) {
      for (std::size_t b = 0; b < SurfaceSums::kShells; ++b) {
        gram(a, b) =
            harmonic_product(shells[a], shells[b], l) / (2.0 * static_cast<double>(l) + 1.0);
      }
    }
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(gram);
    const auto& axes = solver.eigenvectors();
    const Matrix root =
        axes * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() * axes.transpose();
    for (std::size_t a = 0; a < SurfaceSums::kShells; ++a) {
      for (std::size_t b = a; b < SurfaceSums::kShells; ++b) {
        bytes.push_back(signed_root_byte(root(a, b)));
      }
    }
  }
  return bytes;
}

// Pairs of landmarks: distance × the angles of both normals with the line between × with each
// other. Source: E. Wahl, U. Hillenbrand, G. Hirzinger, "Surflet-Pair-Relation Histograms", 3DIM
// 2003. Differs: normals have no sign; landmarks instead of random pairs.
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
      const double weight = 2.0 * marks.weight[a] * marks.weight[b];
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t i = k & 1U;
        const std::size_t j = k >> 1U;
        const std::size_t tilt = kTilts[tilt_a.bin + i][tilt_b.bin + j];
        const double both = weight * tilt_a.share[i] * tilt_b.share[j];
        double* bin = &bins[(at.bin * 6 + tilt) * kAngles + bend.bin];
        bin[0] += both * at.share[0] * bend.share[0];
        bin[1] += both * at.share[0] * bend.share[1];
        bin[6 * kAngles] += both * at.share[1] * bend.share[0];
        bin[6 * kAngles + 1] += both * at.share[1] * bend.share[1];
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
  const Harmonics<kDegree> harmonics;
  Look to;
  const double side = std::cbrt(solid.volume);
  for (const Solid::Cell& cell : solid.cells) {
    look(harmonics, cell.centroid - solid.frame.centroid, to);
    const Tent band = tent(thickness_position(cell.thickness, side, kThinnestInside), kBands);
    const Tent shell = tent(to.distance / (kReach * solid.frame.size), kShells);
    for (std::size_t k = 0; k < 4; ++k) {
      const double weight = cell.share * band.share[k & 1U] * shell.share[k >> 1U];
      add(bins[(band.bin + (k & 1U)) * kShells + shell.bin + (k >> 1U)], weight, to.harmonics);
    }
  }
  return energies(bins);
}

// Landmarks joined where an inner edge leads from one's points to the other's.
Graph find_roads(const DelaunayComplex& complex, const Solid& solid, const Landmarks& marks) {
  std::vector<std::uint8_t> joined(marks.count() * marks.count(), 0);
  for (const Solid::Cell& cell : solid.cells) {
    const auto& corners = complex.cells[cell.cell];
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t row = marks.owner[corners[i]] * marks.count();
      for (std::size_t k = 0; k < 4; ++k) joined[row + marks.owner[corners[k]]] = 1;
    }
  }
  Graph roads(marks.count());
  for (std::uint32_t a = 0; a < marks.count(); ++a) {
    for (std::uint32_t b = 0; b < marks.count(); ++b) {
      if (a == b || joined[a * marks.count() + b] == 0) continue;
      roads[a].emplace_back(b, distance(marks.position[a], marks.position[b]));
    }
  }
  return roads;
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
  const Graph roads = find_roads(complex, solid, marks);
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
  // A single landmark is as far from the others as they are from it.
  for (double& value : centricity) value = mean > 0.0 ? value / mean : 1.0;
  return centricity;
}

// Thickness × centricity, by volume.
Bytes centricity_table(const DelaunayComplex& complex, const Surface& surface, const Solid& solid) {
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
  Surface surface{
      .points = complex.vertices, .frame = frame_of_points(complex.vertices), .landmarks = {}};
  std::array<Bytes, kTableBlocks.size()> blocks;
  const auto invoke = [threads](const auto& a, const auto& b) {
    if (resolve_threads(threads) == 1) {
      a();
      b();
    } else {
      const GiverScope giver;
      tbb::task_arena(2).execute([&] { tbb::parallel_invoke(handed(a), handed(b)); });
    }
  };
  invoke([&] { solid = find_solid(complex, basins); },
         [&] {
           surface.landmarks =
               find_landmarks(complex.vertices, surface.frame.centroid,
                              std::min(kLandmarks, complex.vertices.size() / kPointsPerLandmark));
         });
  const bool inside = solid.volume > 0.0;
  invoke(
      [&] {
        const SurfaceSums sums = sum_surface(surface, solid);
        blocks[0] = shells_table(sums.shells);
        blocks[1] = energies(sums.facing);
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
