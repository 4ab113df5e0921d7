#include "denoise/smooth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <morsel/error.hpp>
#include <numeric>

#include "base/cancel.hpp"
#include "base/neighborhoods.hpp"
#include "base/quantile.hpp"
#include "base/test_shapes.hpp"
#include "denoise/planes.hpp"

namespace morsel {
namespace {

using shapes::Points;

// All of them go on.
Cover whole(const Points& points) {
  Cover cover;
  cover.points = points;
  cover.kept.resize(points.size());
  std::iota(cover.kept.begin(), cover.kept.end(), 0);
  cover.by = cover.kept;
  return cover;
}

Points smoothed(const Points& points, int rounds = 3) { return smooth(whole(points), rounds, 0); }

double mean_radius(const Points& points) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += norm(p);
  return sum / static_cast<double>(points.size());
}

// Two sides of a wall `thickness` apart, 2 by 2 wide.
Points wall(std::size_t count, double thickness) {
  Random random(5);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(
        {2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0, i % 2 == 0 ? 0.0 : thickness});
  }
  return points;
}

// One round, rule by rule as in docs/method.md, in doubles.
Points round_by_the_book(const Points& points) {
  const Neighborhoods near = find_neighborhoods(points, 40, 1, 24);
  const Planes planes = fit_planes(points, near, std::min<std::size_t>(24, near.size), 1);
  const double s = 2.0 * quantile(planes.residual, 0.5);
  const auto weight = [&](std::size_t i, const Vec3& d, double cosine, double height) {
    const double h = 0.5 * near.reach[i];
    const double turn = 1.0 - std::abs(cosine);
    const double x = squared_norm(d) / (2.0 * h * h) + turn * turn / (2.0 * 0.3 * 0.3) +
                     height * height / (2.0 * s * s);
    return std::pow(std::max(1.0 - x / 8.0, 0.0), 8);
  };
  Points normals = planes.normal;
  for (int filtering = 0; filtering < 3; ++filtering) {
    Points filtered;
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vec3 sum = normals[i];
      for (const std::uint32_t j : near.of(i)) {
        const Vec3 d = points[j] - points[i];
        const double cosine = dot(normals[i], normals[j]);
        sum = sum + weight(i, d, cosine, dot(normals[i], d)) * cosine * normals[j];
      }
      filtered.push_back((1.0 / norm(sum)) * sum);
    }
    normals = filtered;
  }
  Points moved;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double total = 1.0;
    double sum = 0.0;
    for (const std::uint32_t j : near.of(i)) {
      const Vec3 d = points[j] - points[i];
      const double cosine = dot(normals[i], normals[j]);
      const double sign = cosine < 0.0 ? -1.0 : 1.0;
      const double height = 0.5 * (dot(normals[i], d) + sign * dot(normals[j], d));
      total += weight(i, d, cosine, height);
      sum += weight(i, d, cosine, height) * height;
    }
    moved.push_back(points[i] + (sum / total) * normals[i]);
  }
  return moved;
}

TEST(SmoothTest, ARoundIsWhatTheRulesSay) {
  // Of few points all are neighbours, whose number is no multiple of four.
  for (const std::size_t count : {20, 31, 2000}) {
    const Points points = shapes::noisy(shapes::sphere(count, {5.0, 0.0, -3.0}, 2.0), 0.04);
    const Points expected = round_by_the_book(points);
    const Points found = smoothed(points, 1);
    for (std::size_t i = 0; i < count; ++i) EXPECT_LT(distance(found[i], expected[i]), 1e-5) << i;
  }
}

TEST(SmoothTest, FewPointsCanBeSmoothedAgainAndAgain) {
  for (std::size_t count = 0; count < 45; ++count) {
    for (const Vec3& p : smoothed(shapes::noisy(shapes::sphere(count), 0.02), 3)) {
      EXPECT_TRUE(is_finite(p)) << count;
    }
  }
}

TEST(SmoothTest, CurvedSurfacesAreNotPulledIn) {
  // Mean planes through 40 of 2,000 points lie 0.005 inside the unit sphere, in every round.
  const Points points = shapes::noisy(shapes::sphere(2000), 0.02);
  EXPECT_NEAR(mean_radius(smoothed(points)), 1.0, 0.002);
}

TEST(SmoothTest, BothSidesOfAThinWallStayApart) {
  // 40 neighbours reach 0.08 far; the wall is thinner than that, with noise of a seventh of it.
  const double thickness = 0.07;
  const double sigma = 0.01;
  const Points clean = wall(20000, thickness);
  const Points points = smoothed(shapes::noisy(clean, sigma));
  std::size_t astray = 0;
  double squares = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off = points[i].z - clean[i].z;
    astray += std::abs(off) > 0.5 * thickness ? 1 : 0;
    squares += off * off;
  }
  EXPECT_LT(astray, points.size() / 200);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(points.size())), 0.5 * sigma);
}

TEST(SmoothTest, ExactPlanesStayAsTheyAre) {
  const Points points = wall(2000, 0.0);
  EXPECT_EQ(smoothed(points), points);
}

TEST(SmoothTest, NoRoundsMoveNothing) {
  const Points points = shapes::noisy(shapes::sphere(500), 0.02);
  EXPECT_EQ(smoothed(points, 0), points);
}

TEST(SmoothTest, OfACoverThoseKeptAreMoved) {
  const Points points = shapes::noisy(shapes::sphere(8000), 0.02);
  const Cover cover = cover_cloud(points, 2000, 12, 0);
  const Points alone = cover.kept_points();
  const auto off = [](const Points& some) {
    double sum = 0.0;
    for (const Vec3& p : some) sum += (norm(p) - 1.0) * (norm(p) - 1.0);
    return std::sqrt(sum / static_cast<double>(some.size()));
  };
  const Points together = smooth(cover, 3, 2);
  EXPECT_EQ(together.size(), alone.size());
  EXPECT_LT(off(together), 0.4 * off(alone));
  EXPECT_EQ(together, smooth(cover, 3, 1));
}

TEST(SmoothTest, CanBeCancelled) {
  const Points points = shapes::noisy(shapes::sphere(500), 0.02);
  Progress progress;
  progress.cancel();
  const CancelScope scope(&progress);
  EXPECT_THROW((void)smoothed(points, 1), Error);
}

TEST(PlanesTest, NormalAndResidualOfAKnownPatch) {
  // Eight neighbours of the origin at heights of +h and -h in turn, in the plane z = 0 on average.
  const double h = 0.1;
  Points points{{0.0, 0.0, 0.0}};
  for (int i = 0; i < 8; ++i) {
    const double angle = i * 0.25 * 3.14159265358979323846;
    points.push_back({std::cos(angle), std::sin(angle), i % 2 == 0 ? h : -h});
  }
  const Planes planes = fit_planes(points, find_neighborhoods(points, 8, 1), 8, 1);
  EXPECT_NEAR(std::abs(planes.normal[0].z), 1.0, 1e-12);
  EXPECT_NEAR(planes.residual[0], h * std::sqrt(8.0 / 9.0), 1e-12);
}

}  // namespace
}  // namespace morsel
