#include "plane/plane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <morsel/error.hpp>
#include <numbers>

#include "plane/drawing.hpp"

namespace morsel::plane {
namespace {

const std::vector<Sausage> kDumbbell{
    {{-2, 0}, {-2, 0}, 1.0}, {{2, 0}, {2, 0}, 1.0}, {{-2, 0}, {2, 0}, 0.3}};

Shape dumbbell() {
  return find_parts(sample_outline(kDumbbell, 400, 0.005, 1), {.big_ball_ratio = 2.0});
}

double area(const Shape& shape, const Triangle& t) {
  const Point& a = shape.points[t.corners[0]];
  const Point& b = shape.points[t.corners[1]];
  const Point& c = shape.points[t.corners[2]];
  return 0.5 * ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
}

TEST(SampleOutline, LiesOnTheOutline) {
  for (const Point& p : sample_outline(kDumbbell, 500, 0.0, 3)) {
    double least = 1e9;
    for (const Sausage& s : kDumbbell) {
      const double x = std::clamp(p.x, s.a.x, s.b.x);
      least = std::min(least, std::hypot(p.x - x, p.y) - s.radius);
    }
    EXPECT_NEAR(least, 0.0, 1e-9);
  }
  EXPECT_EQ(sample_outline(kDumbbell, 20, 0.1, 3), sample_outline(kDumbbell, 20, 0.1, 3));
}

TEST(FindParts, FillsTheDumbbell) {
  const Shape shape = dumbbell();
  double inside = 0.0;
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    if (shape.inner[i]) inside += area(shape, shape.triangles[i]);
  }
  const double truth = 2.0 * std::numbers::pi + 0.6 * (4.0 - 2.0 * std::sqrt(0.91)) - 0.04;
  EXPECT_NEAR(inside / truth, 1.0, 0.06);
}

TEST(FindParts, FlowGrowsAndEndsAtMaximaThatHoldTheirCenters) {
  const Shape shape = dumbbell();
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    if (shape.flow[i] == kNone) continue;
    EXPECT_GT(shape.triangles[shape.flow[i]].radius, shape.triangles[i].radius);
  }
  for (std::size_t i = 1; i < shape.maxima.size(); ++i) {
    EXPECT_GE(shape.triangles[shape.maxima[i - 1]].radius, shape.triangles[shape.maxima[i]].radius);
  }
}

TEST(FindParts, TheBallsAreTwoParts) {
  const Shape shape = dumbbell();
  ASSERT_GE(shape.maxima.size(), 2U);
  const auto part_at = [&](double x) {
    for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
      const Triangle& t = shape.triangles[i];
      if (shape.basin[i] != kNone && shape.flow[i] == kNone && t.radius > 0.8 &&
          std::abs(t.center.x - x) < 0.3) {
        return shape.part[shape.basin[i]];
      }
    }
    return -1;
  };
  EXPECT_GE(part_at(-2.0), 0);
  EXPECT_GE(part_at(2.0), 0);
  EXPECT_NE(part_at(-2.0), part_at(2.0));
}

TEST(FindParts, NeedsThreePoints) { EXPECT_THROW(find_parts({{0, 0}, {1, 0}}, {}), Error); }

TEST(ClearestSaddle, SeparatesTwoMaximaByAnEmptyDisk) {
  const Shape shape = dumbbell();
  const auto saddle = clearest_saddle(shape);
  ASSERT_TRUE(saddle.has_value());
  const Point& a = shape.points[saddle->ends[0]];
  const Point& b = shape.points[saddle->ends[1]];
  const Point middle{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
  for (const Point& p : shape.points) {
    EXPECT_GE(distance(p, middle), 0.5 * distance(a, b) - 1e-12);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(saddle->ways[k].back(), saddle->maxima[k]);
    EXPECT_GT(shape.triangles[saddle->maxima[k]].radius, 0.5 * distance(a, b));
  }
  EXPECT_NE(saddle->maxima[0], saddle->maxima[1]);
}

TEST(Drawing, HasAPictureForEachStep) {
  const Shape shape = dumbbell();
  const auto pictures = draw_steps(shape);
  EXPECT_EQ(pictures.size(), 6U);
  for (const std::string& svg : pictures) {
    EXPECT_TRUE(svg.starts_with("<svg "));
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
  }
  EXPECT_NE(draw_saddle(shape, *clearest_saddle(shape)).find("polyline"), std::string::npos);
}

}  // namespace
}  // namespace morsel::plane
