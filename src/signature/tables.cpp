#include "signature/tables.hpp"

#include <algorithm>
#include <cmath>

#include "signature/harmonics.hpp"

namespace morsel {
namespace {

// A position on an axis of `count` bins, shared linearly between the two nearest; clamped.
struct Tent {
  std::size_t low = 0;
  double high_share = 0.0;
};

Tent tent(double position, std::size_t count) {
  const double at = std::clamp(position * static_cast<double>(count) - 0.5, 0.0,
                               static_cast<double>(count - 1));
  const auto low = std::min(static_cast<std::size_t>(at), count - 2);
  return {low, at - static_cast<double>(low)};
}

// The thickness of each cell: the largest inner ball that its corners nearly touch.
std::vector<double> cell_thickness(const DelaunayComplex& complex, const Basins& basins) {
  std::vector<double> corner(complex.vertices.size(), 0.0);
  for (std::size_t c = 0; c < complex.cell_count(); ++c) {
    const std::uint32_t b = basins.basin_of_cell[c];
    if (b == kNoBasin) continue;
    const double ball = std::min(complex.radii[c], complex.radii[basins.maximum[b]]);
    for (const std::uint32_t v : complex.cells[c]) corner[v] = std::max(corner[v], ball);
  }
  std::vector<double> thickness(complex.cell_count(), 0.0);
  for (std::size_t c = 0; c < complex.cell_count(); ++c) {
    for (const std::uint32_t v : complex.cells[c]) thickness[c] = std::max(thickness[c], corner[v]);
  }
  return thickness;
}

constexpr std::size_t kThicknessBands = 4;
constexpr std::size_t kShells = 6;
constexpr std::size_t kDegree = 6;

void append_thickness_harmonics(const DelaunayComplex& complex, const Basins& basins,
                                const Interior& interior, const Frame& frame,
                                std::vector<std::uint8_t>& tables) {
  constexpr std::size_t kCount = harmonic_count(kDegree);
  const std::vector<double> thickness = cell_thickness(complex, basins);
  const double side = std::cbrt(interior.volume);
  std::vector<double> sums(kThicknessBands * kShells * kCount, 0.0);
  std::array<double, kCount> values{};
  for (std::size_t c = 0; c < complex.cell_count(); ++c) {
    if (basins.basin_of_cell[c] == kNoBasin) continue;
    const Vec3 arm = cell_centroid(complex, c) - frame.centroid;
    const double r = norm(arm);
    evaluate_harmonics(r > 0.0 ? (1.0 / r) * arm : Vec3{0, 0, 1}, kDegree, values);
    const double share = std::abs(cell_volume(complex, c)) / interior.volume;
    const Tent t = tent(std::log(thickness[c] / side / 0.03) / std::log(0.8 / 0.03),
                        kThicknessBands);
    const Tent s = tent(r / (2.4 * frame.size), kShells);
    for (std::size_t i = 0; i < 4; ++i) {
      const double weight = share * (i / 2 == 0 ? 1.0 - t.high_share : t.high_share) *
                            (i % 2 == 0 ? 1.0 - s.high_share : s.high_share);
      double* bin = &sums[((t.low + i / 2) * kShells + s.low + i % 2) * kCount];
      for (std::size_t k = 0; k < kCount; ++k) bin[k] += weight * values[k];
    }
  }
  for (std::size_t bin = 0; bin < kThicknessBands * kShells; ++bin) {
    for (std::size_t l = 0; l <= kDegree; ++l) {
      const double energy = harmonic_energy(std::span(sums).subspan(bin * kCount, kCount), l);
      const double value = std::sqrt(energy / std::sqrt(2.0 * static_cast<double>(l) + 1.0));
      tables.push_back(static_cast<std::uint8_t>(std::lround(255.0 * std::min(value, 1.0))));
    }
  }
}

}  // namespace

std::vector<std::uint8_t> make_tables(const DelaunayComplex& complex, const Interior& interior,
                                      const Basins& basins, const Frame& frame) {
  std::vector<std::uint8_t> tables;
  tables.reserve(kTableSize);
  if (interior.volume > 0.0) {
    append_thickness_harmonics(complex, basins, interior, frame, tables);
  }
  tables.resize(kTableSize, 0);
  return tables;
}

}  // namespace morsel
