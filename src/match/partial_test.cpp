#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <morsel/error.hpp>
#include <morsel/partial.hpp>
#include <numbers>
#include <vector>

#include "base/random.hpp"

namespace morsel {
namespace {

constexpr MatchOptions kPartial{.mode = MatchMode::kPartial};

// Points all over a few capsules of different lengths and widths around a core: no symmetries.
std::vector<Vec3> figure(std::uint64_t seed, std::size_t count = 2000) {
  struct Limb {
    Vec3 from, to;
    double radius;
  };
  Random random(seed);
  std::vector<Limb> limbs;
  for (int i = 0; i < 5; ++i) {
    const Vec3 end{random.normal(), random.normal(), random.normal()};
    limbs.push_back({{0, 0, 0},
                     (1.0 + 2.0 * random.uniform()) * ((1.0 / norm(end)) * end),
                     0.15 + 0.35 * random.uniform()});
  }
  const auto inside = [&](const Vec3& p, const Limb& limb) {
    const Vec3 way = limb.to - limb.from;
    const double along = std::clamp(dot(p - limb.from, way) / squared_norm(way), 0.0, 1.0);
    return distance(p, limb.from + along * way) < 0.999 * limb.radius;
  };
  std::vector<Vec3> points;
  while (points.size() < count) {
    const Limb& limb = limbs[random.below(limbs.size())];
    Vec3 out{random.normal(), random.normal(), random.normal()};
    out = (limb.radius / norm(out)) * out;
    const Vec3 p = limb.from + random.uniform() * (limb.to - limb.from) + out;
    const Vec3 way = limb.to - limb.from;
    const double along = std::clamp(dot(p - limb.from, way) / squared_norm(way), 0.0, 1.0);
    // Onto the capsule, and only where no other limb covers it.
    const Vec3 axis = limb.from + along * way;
    const Vec3 on = axis + (limb.radius / distance(p, axis)) * (p - axis);
    if (std::ranges::none_of(limbs, [&](const Limb& other) { return inside(on, other); })) {
      points.push_back(on);
    }
  }
  return points;
}

std::vector<Vec3> cut_at(const std::vector<Vec3>& points, double height) {
  std::vector<Vec3> rest;
  std::ranges::copy_if(points, std::back_inserter(rest),
                       [&](const Vec3& p) { return p.x + 0.3 * p.y < height; });
  return rest;
}

// Turned about z and x, scaled, moved and perhaps mirrored.
std::vector<Vec3> posed(std::vector<Vec3> points, double scale, bool mirrored) {
  for (Vec3& p : points) {
    if (mirrored) p.x = -p.x;
    p = {0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y, p.z};
    p = {p.x, 0.28 * p.y - 0.96 * p.z, 0.96 * p.y + 0.28 * p.z};
    p = scale * p + Vec3{3, -7, 1};
  }
  return points;
}

Surface surface_of(const std::vector<Vec3>& points) {
  return {points, std::vector<int>(points.size(), 0)};
}

double root_mean_square(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += squared_distance(a[i], b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(Partial, APieceFindsItsPlaceAndScale) {
  const std::vector<Vec3> whole = figure(1);
  for (const double height : {0.4, -0.2}) {
    // Other samples than the whole has.
    const std::vector<Vec3> piece = cut_at(figure(1, 3000), height);
    for (const bool mirrored : {false, true}) {
      const std::vector<Vec3> moved = posed(piece, 2.5, mirrored);
      const Match found = match_partial(surface_of(whole), surface_of(moved), kPartial);
      EXPECT_GT(found.score, 0.85) << height << mirrored;
      EXPECT_EQ(found.mirrored, mirrored);
      EXPECT_LT(root_mean_square(on_target(found, moved), piece), 0.08) << height << mirrored;
    }
  }
}

TEST(Partial, KnownScaleIsKept) {
  const std::vector<Vec3> piece = posed(cut_at(figure(2), 0.2), 1.0, false);
  MatchOptions options = kPartial;
  options.same_scale = true;
  const Surface whole = surface_of(figure(2));
  const Match found = match_partial(whole, surface_of(piece), options);
  EXPECT_GT(found.score, 0.85);
  const auto& m = found.target_from_source;
  EXPECT_NEAR(m[0] * m[0] + m[4] * m[4] + m[8] * m[8], 1.0, 1e-9);
  const Match twice =
      match_partial(whole, surface_of(posed(cut_at(figure(2), 0.2), 2.0, false)), options);
  EXPECT_LT(twice.score, 0.8);
}

TEST(Partial, WithoutMirroringAMirroredPieceFitsWorse) {
  MatchOptions options = kPartial;
  options.mirror = false;
  const Surface whole = surface_of(figure(3));
  const std::vector<Vec3> piece = cut_at(figure(3), 0.4);
  const Match proper = match_partial(whole, surface_of(posed(piece, 1.0, false)), options);
  const Match mirrored = match_partial(whole, surface_of(posed(piece, 1.0, true)), options);
  EXPECT_FALSE(mirrored.mirrored);
  EXPECT_LT(mirrored.score, proper.score - 0.1);
}

TEST(Partial, SearchFindsTheShapeThatAPieceIsOf) {
  std::vector<std::vector<Vec3>> shapes;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) shapes.push_back(figure(seed));
  const auto whole = [&](std::size_t i) { return surface_of(shapes[i]); };
  for (const std::size_t own : {0, 5, 11}) {
    const Surface piece = surface_of(posed(cut_at(figure(own + 1, 2500), 0.0), 0.3, true));
    const auto hits = search_partial(piece, shapes.size(), whole, 3, kPartial, 1);
    ASSERT_EQ(hits.size(), 3U);
    EXPECT_EQ(hits[0].index, own);
    EXPECT_GT(hits[0].score, hits[1].score + 0.05);
    const auto again = search_partial(piece, shapes.size(), whole, 3, kPartial, 2);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      EXPECT_EQ(hits[i].index, again[i].index);
      EXPECT_EQ(hits[i].score, again[i].score);
    }
  }
}

TEST(Partial, PartsGoWhereTheirPointsLie) {
  const std::vector<Vec3> points = figure(4);
  std::vector<int> parts;
  for (const Vec3& p : points) parts.push_back(p.x + 0.3 * p.y < -0.3 ? 2 : p.z > 0.0 ? 1 : 0);
  std::vector<Vec3> piece;
  std::vector<int> of_piece;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (parts[i] == 0) continue;
    piece.push_back(points[i]);
    of_piece.push_back(parts[i] == 2 ? 0 : 1);
  }
  const Match found =
      match_partial(Surface(points, parts), Surface(posed(piece, 4.0, false), of_piece), kPartial);
  ASSERT_EQ(found.matched.size(), 2U);
  for (const MatchedPart& pair : found.matched) EXPECT_EQ(pair.target, pair.source == 0 ? 2 : 1);
  EXPECT_EQ(found.unmatched_target, std::vector<int>{0});
  EXPECT_TRUE(found.unmatched_source.empty());
  EXPECT_NEAR(found.matched[0].contribution + found.matched[1].contribution, 1.0, 0.05);
}

TEST(Partial, TheOrderOfThePointsDoesNotMatter) {
  std::vector<Vec3> piece = cut_at(figure(5), 0.4);
  const Surface whole = surface_of(figure(5));
  const Match found = match_partial(whole, surface_of(piece), kPartial);
  std::ranges::reverse(piece);
  const Match reversed = match_partial(whole, surface_of(piece), kPartial);
  EXPECT_EQ(found.target_from_source, reversed.target_from_source);
  EXPECT_EQ(found.score, reversed.score);
}

TEST(Partial, TooFewPointsFitNothing) {
  const Surface few = surface_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Surface whole = surface_of(figure(1));
  EXPECT_EQ(match_partial(whole, few, kPartial).score, 0.0);
  EXPECT_EQ(match_partial(few, whole, kPartial).score, 0.0);
  EXPECT_EQ(recurrence(few, few, kPartial), 0.0);
  const Surface same = surface_of(std::vector<Vec3>(100, Vec3{1, 2, 3}));
  EXPECT_EQ(match_partial(whole, same, kPartial).score, 0.0);
  std::vector<Vec3> line;
  for (int i = 0; i < 100; ++i) line.push_back({0.1 * i, 0, 0});
  EXPECT_TRUE(std::isfinite(match_partial(whole, surface_of(line), kPartial).score));
}

TEST(Partial, SignaturesAreNotPieces) {
  EXPECT_THROW((void)match({}, {}, kPartial), Error);
  EXPECT_THROW((void)match_score({}, {}, kPartial), Error);
  EXPECT_THROW((MatchOptions{.method = Method::kPaper, .mode = MatchMode::kPartial}.check()),
               Error);
  EXPECT_THROW((MatchOptions{.same_scale = true}.check()), Error);
}

TEST(Partial, NamesOfModes) {
  for (const MatchMode mode : {MatchMode::kRigid, MatchMode::kArticulated, MatchMode::kPartial}) {
    EXPECT_EQ(mode_named(mode_name(mode)), mode);
  }
  EXPECT_FALSE(mode_named("bent"));
}

}  // namespace
}  // namespace morsel
