#include "denoise/cover.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/test_shapes.hpp"

namespace morsel {
namespace {

using shapes::Points;

constexpr std::size_t kSize = 12;

std::size_t outliers_of(const Cover& cover) {
  return static_cast<std::size_t>(std::ranges::count(cover.is_outlier, true));
}

void expect_sizes(const Points& points, const Cover& cover) {
  ASSERT_EQ(cover.is_outlier.size(), points.size());
  ASSERT_EQ(cover.stand_in.size(), points.size());
  ASSERT_EQ(cover.points.size() + outliers_of(cover), points.size());
  ASSERT_EQ(cover.by.size(), cover.points.size());
  ASSERT_EQ(cover.neighborhoods.reach.size(), cover.kept.size());
}

void expect_sound(const Points& points, const Cover& cover) {
  expect_sizes(points, cover);
  EXPECT_TRUE(std::ranges::is_sorted(cover.kept));
  for (std::uint32_t k = 0; k < cover.kept.size(); ++k) EXPECT_EQ(cover.by.at(cover.kept[k]), k);
  for (std::size_t i = 0, own = 0; i < points.size(); ++i) {
    EXPECT_LT(cover.stand_in[i], cover.kept.size());
    if (cover.is_outlier[i]) continue;
    EXPECT_EQ(cover.points[own], points[i]);
    EXPECT_EQ(cover.by[own++], cover.stand_in[i]);
  }
}

TEST(CoverTest, AllStandForThemselves) {
  const Points points = shapes::sphere(2000);
  const Cover cover = cover_cloud(points, 2000, kSize, 0);
  expect_sound(points, cover);
  EXPECT_EQ(cover.kept.size(), cover.points.size());
  EXPECT_LT(outliers_of(cover), 20U);
}

TEST(CoverTest, AboutSoManyAreKeptAndNoneBesideAnother) {
  const Points points = shapes::sphere(10000);
  for (const std::size_t most : {2500, 5000, 9000}) {
    const Cover cover = cover_cloud(points, most, kSize, 0);
    expect_sound(points, cover);
    const auto kept = static_cast<double>(cover.kept.size());
    const double beyond = static_cast<double>(points.size()) / static_cast<double>(most) - 1.0;
    EXPECT_NEAR(kept, static_cast<double>(most), 0.1 * static_cast<double>(most));
    for (std::size_t a = 0; a < cover.kept.size(); ++a) {
      for (std::size_t b = a + 1; b < cover.kept.size(); ++b) {
        const double apart = distance(cover.points[cover.kept[a]], cover.points[cover.kept[b]]);
        const double reach = std::min(cover.neighborhoods.reach[a], cover.neighborhoods.reach[b]);
        ASSERT_GT(apart, 0.99 * std::sqrt(beyond / 0.42 / kSize) * reach);
      }
    }
  }
}

TEST(CoverTest, NoMoreAreKeptInNoise) {
  // The spacing of the points on the unit sphere is some 0.025.
  for (const double noise : {0.01, 0.03, 0.1}) {
    const Points points = shapes::noisy(shapes::sphere(20000), noise);
    const Cover cover = cover_cloud(points, 5000, kSize, 0);
    expect_sound(points, cover);
    EXPECT_NEAR(static_cast<double>(cover.kept.size()), 5000.0, 400.0) << noise;
  }
}

TEST(CoverTest, EachPointIsStoodForByOneNear) {
  const Points points = shapes::sphere(8000);
  const Cover cover = cover_cloud(points, 2000, kSize, 0);
  for (std::size_t i = 0; i < cover.points.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t k : cover.kept) {
      nearest = std::min(nearest, distance(cover.points[i], cover.points[k]));
    }
    EXPECT_LE(distance(cover.points[i], cover.points[cover.kept[cover.by[i]]]),
              1.5 * nearest + 0.02);
  }
}

TEST(CoverTest, FollowsTheDensity) {
  // Half of a sphere four times as dense as the other.
  Points points = shapes::sphere(8000);
  std::erase_if(points, [i = 0](const Vec3& p) mutable { return p.z < 0.0 && i++ % 4 != 0; });
  const Cover cover = cover_cloud(points, points.size() / 3, kSize, 0);
  double above = 0.0;
  double beneath = 0.0;
  for (const std::uint32_t i : cover.kept) (cover.points[i].z > 0.0 ? above : beneath) += 1.0;
  EXPECT_NEAR(above / beneath, 4.0, 0.6);
}

TEST(CoverTest, OutliersGoAndWhatIsBeneathThemStays) {
  const Points sphere = shapes::sphere(8000);
  Points strays;
  for (std::size_t i = 0; i < 40; ++i) strays.push_back(1.2 * sphere[i * 200]);
  const Points points = shapes::joined(strays, sphere);
  const Cover cover = cover_cloud(points, 2000, kSize, 0);
  expect_sound(points, cover);
  for (std::size_t i = 0; i < strays.size(); ++i) EXPECT_TRUE(cover.is_outlier[i]) << i;
  EXPECT_LT(outliers_of(cover), strays.size() + 40);
  for (const Vec3& stray : strays) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t k : cover.kept) {
      nearest = std::min(nearest, distance((1.0 / 1.2) * stray, cover.points[k]));
    }
    EXPECT_LT(nearest, 0.1);  // of 2,000 the spacing is 0.08
  }
}

TEST(CoverTest, FewPointsAndRegularOnes) {
  for (std::size_t count = 0; count <= 14; ++count) {
    const Points points = shapes::cube_cloud(count);
    expect_sound(points, cover_cloud(points, std::max<std::size_t>(count / 2, 1), kSize, 0));
  }
  for (const double scale : {1e-300, 1.0, 1e200}) {
    const Points points = shapes::scaled(shapes::grid(9), scale);
    const Cover cover = cover_cloud(points, 200, kSize, 0);
    expect_sound(points, cover);
    EXPECT_GE(cover.kept.size(), 100U);  // many are equally near: all are covered or none
  }
}

}  // namespace
}  // namespace morsel
