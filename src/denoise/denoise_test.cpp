#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <morsel/denoise.hpp>
#include <morsel/error.hpp>
#include <string>
#include <vector>

#include "base/neighborhoods.hpp"
#include "base/test_shapes.hpp"

namespace morsel {
namespace {

using shapes::Points;

double rms_off_unit_sphere(const Points& points) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += (norm(p) - 1.0) * (norm(p) - 1.0);
  return std::sqrt(sum / static_cast<double>(points.size()));
}

void expect_sound(const Points& input, const Denoised& denoised) {
  ASSERT_EQ(denoised.stand_in.size(), input.size());
  for (const std::uint32_t i : denoised.stand_in) ASSERT_LT(i, denoised.points.size());
  EXPECT_LE(denoised.outlier_count, input.size());
  EXPECT_EQ(denoised.points.empty(), input.empty());
}

void expect_same(const Denoised& a, const Denoised& b) {
  EXPECT_TRUE(a.points == b.points);
  EXPECT_TRUE(a.stand_in == b.stand_in);
  EXPECT_EQ(a.kept_share, b.kept_share);
  EXPECT_EQ(a.noise, b.noise);
  EXPECT_EQ(a.spacing, b.spacing);
  EXPECT_EQ(a.rounds, b.rounds);
  EXPECT_EQ(a.outlier_count, b.outlier_count);
}

TEST(DenoiseTest, CleanSamplesStayAsTheyAre) {
  for (const Points& points : {shapes::sphere(10000), shapes::torus(10000, 2.0, 0.7),
                               shapes::changed(shapes::cube_cloud(5000), [](const Vec3& p) {
                                 return Vec3{p.x, p.y, 0.25};
                               })}) {
    const Denoised denoised = denoise(points);
    expect_sound(points, denoised);
    EXPECT_EQ(denoised.rounds, 0);
    EXPECT_LT(denoised.outlier_count, points.size() / 100);
    std::size_t stood_in = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      stood_in += denoised.points[denoised.stand_in[i]] == points[i] ? 0 : 1;
    }
    EXPECT_EQ(stood_in, denoised.outlier_count);
  }
}

TEST(DenoiseTest, NoisySphereComesCloserToItsSurface) {
  const double sigma = 0.005 * 2.0 * std::sqrt(3.0);  // 0.5% of the diagonal
  const Points points = shapes::noisy(shapes::sphere(20000), sigma);
  const Denoised denoised = denoise(points);
  expect_sound(points, denoised);
  EXPECT_GT(denoised.rounds, 0);
  EXPECT_LT(rms_off_unit_sphere(denoised.points), 0.5 * rms_off_unit_sphere(points));
  EXPECT_GT(denoised.noise, 0.3 * sigma);
  EXPECT_LT(denoised.noise, 1.5 * sigma);
}

TEST(DenoiseTest, RoundsAreDoneAsAsked) {
  const Points points = shapes::noisy(shapes::sphere(3000), 0.01);
  const Denoised none = denoise(points, {.rounds = 0});
  for (const int rounds : {0, 1, 2, 20}) {
    const Denoised denoised = denoise(points, {.rounds = rounds});
    expect_sound(points, denoised);
    EXPECT_EQ(denoised.rounds, rounds);
    EXPECT_EQ(denoised.noise, none.noise);  // of the input, not of the result
    EXPECT_EQ(denoised.stand_in, none.stand_in);
    EXPECT_EQ(denoised.points == none.points, rounds == 0);
  }
  const Denoised once = denoise(points, {.rounds = 1});
  EXPECT_LT(rms_off_unit_sphere(once.points), 0.7 * rms_off_unit_sphere(none.points));
}

TEST(DenoiseTest, FarOutliersAreSetApart) {
  const Points clean = shapes::sphere(10000);
  Random random(12);
  Points outliers;
  while (outliers.size() < 100) {
    const Vec3 p = 6.0 * (shapes::random_in_cube(random) - Vec3{0.5, 0.5, 0.5});
    if (norm(p) > 1.5) outliers.push_back(p);
  }
  const Points points = shapes::joined(clean, outliers);
  for (const int rounds : {0, 2}) {
    const Denoised denoised = denoise(points, {.rounds = rounds});
    expect_sound(points, denoised);
    EXPECT_GE(denoised.outlier_count, 100U);
    EXPECT_LT(denoised.outlier_count, 150U);
    EXPECT_EQ(denoised.points.size(), points.size() - denoised.outlier_count);
    for (const Vec3& p : denoised.points) EXPECT_LT(norm(p), 1.2);
    if (rounds > 0) continue;
    for (std::size_t i = clean.size(); i < points.size(); ++i) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec3& p : denoised.points) nearest = std::min(nearest, distance(p, points[i]));
      EXPECT_EQ(distance(points[i], denoised.points[denoised.stand_in[i]]), nearest);
    }
  }
}

TEST(DenoiseTest, DoesNotDependOnOrderOrThreads) {
  const Points points = shapes::joined(shapes::noisy(shapes::sphere(6000), 0.01),
                                       shapes::scaled(shapes::cube_cloud(60), 5.0));
  const auto shuffle = shapes::permutation(points.size());
  const Denoised one = denoise(points, {.rounds = {}, .threads = 1});
  expect_same(one, denoise(points, {.rounds = {}, .threads = 2}));
  Denoised shuffled = one;
  shuffled.stand_in = shapes::permuted(one.stand_in, shuffle);
  expect_same(shuffled, denoise(shapes::permuted(points, shuffle)));
}

TEST(DenoiseTest, OfMorePointsSoManyGoOn) {
  const Points clean = shapes::sphere(9000);
  Points points = clean;
  for (const Vec3& p : shapes::scaled(shapes::cube_cloud(300), 20.0)) {
    points.push_back(p + Vec3{2.0, 2.0, 2.0});
  }
  const Denoised all = denoise(points);
  EXPECT_EQ(all.kept_share, 1.0);
  for (const std::size_t most : {500, 3000, 8000}) {
    const Denoised some = denoise(points, {.rounds = {}, .threads = 2, .most_points = most});
    expect_sound(points, some);
    const auto count = static_cast<double>(some.points.size());
    EXPECT_NEAR(count, static_cast<double>(most), 0.1 * static_cast<double>(most));
    EXPECT_NEAR(some.kept_share, count / std::min(4.0 * static_cast<double>(most), 9000.0), 0.01);
    // All outliers count, those that were not looked at too.
    EXPECT_NEAR(static_cast<double>(some.outlier_count), static_cast<double>(all.outlier_count),
                60.0);
    for (std::size_t i = 0; i < clean.size(); ++i) {
      EXPECT_LT(distance(clean[i], some.points[some.stand_in[i]]), 8.0 / std::sqrt(count));
    }
    expect_same(some, denoise(points, {.rounds = {}, .threads = 1, .most_points = most}));
  }
  EXPECT_EQ(denoise(points, {.rounds = {}, .threads = 0, .most_points = 9300}).points, all.points);
  EXPECT_THROW((void)denoise(points, {.rounds = {}, .threads = 0, .most_points = 0}), Error);
}

TEST(DenoiseTest, PointsThatGoOnKeepApart) {
  const double sigma = 0.003 * 2.0 * std::sqrt(3.0);  // 0.3% of the diagonal
  for (const double noise : {0.0, sigma}) {
    const Points points = shapes::noisy(shapes::sphere(20000), noise);
    const Denoised some = denoise(points, {.rounds = {}, .threads = 0, .most_points = 5000});
    EXPECT_EQ(some.rounds > 0, noise > 0.0);
    EXPECT_LT(rms_off_unit_sphere(some.points), 0.4 * noise + 1e-9);
    // Of as many random points 30% have a neighbour within 0.6 of the radius of one's room.
    const auto count = static_cast<double>(some.points.size());
    const double room = 2.0 / std::sqrt(count);
    const Neighborhoods nearest = find_neighborhoods(some.points, 1, 0);
    const auto close =
        std::ranges::count_if(nearest.reach, [&](double r) { return r < 0.6 * room; });
    EXPECT_LT(static_cast<double>(close), (noise > 0.0 ? 0.06 : 0.01) * count);
  }
}

TEST(DenoiseTest, RepeatedPointsShareTheirStandIn) {
  const Points once = shapes::noisy(shapes::sphere(2000), 0.01);
  const Denoised denoised = denoise(shapes::joined(once, once));
  EXPECT_EQ(denoised.points, denoise(once).points);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(denoised.stand_in[i], denoised.stand_in[i + once.size()]);
  }
}

TEST(DenoiseTest, FewPoints) {
  for (std::size_t count = 0; count <= 14; ++count) {
    const Points points = shapes::cube_cloud(count);
    const Denoised denoised = denoise(points, {.rounds = 2});
    expect_sound(points, denoised);
    for (const Vec3& p : denoised.points) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
  }
}

TEST(DenoiseTest, DegenerateClouds) {
  for (const Points& points :
       {Points(100, {1, 2, 3}), shapes::grid(5), shapes::scaled(shapes::grid(4), 1e-6),
        shapes::scaled(shapes::grid(4), 1e6), shapes::moved(shapes::grid(4), {1e9, 0, 0}),
        shapes::changed(shapes::cube_cloud(100), [](const Vec3& p) {
          return Vec3{p.x, 0, 0};
        })}) {
    for (const int rounds : {0, 3}) {
      const Denoised denoised = denoise(points, {.rounds = rounds});
      expect_sound(points, denoised);
      for (const Vec3& p : denoised.points) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
    }
  }
  EXPECT_EQ(denoise(Points(100, {1, 2, 3})).points.size(), 1U);
}

TEST(DenoiseTest, OptionsAreChecked) {
  for (const int rounds : {-1, 21, 1000}) {
    try {
      (void)denoise({}, {.rounds = rounds});
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kUsage);
      EXPECT_NE(std::string(error.what()).find(std::to_string(rounds)), std::string::npos);
    }
  }
  DenoiseOptions{.rounds = 20}.check();
  DenoiseOptions{.rounds = 0}.check();
  DenoiseOptions{}.check();
}

TEST(DenoiseTest, NamesThePointThatIsNotFinite) {
  Points points = shapes::cube_cloud(30);
  points[21].y = std::numeric_limits<double>::quiet_NaN();
  try {
    (void)denoise(points);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInput);
    EXPECT_NE(std::string(error.what()).find("point 21 "), std::string::npos) << error.what();
  }
}

TEST(DenoiseTest, CanBeCancelled) {
  Progress progress;
  progress.cancel();
  EXPECT_THROW((void)denoise(shapes::cube_cloud(100), {}, &progress), Error);
}

}  // namespace
}  // namespace morsel
