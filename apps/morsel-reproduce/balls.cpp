#include "balls.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <morsel/color.hpp>
#include <numbers>

#include "picture/views.hpp"

namespace morsel::reproduce {
namespace {

constexpr double kSize = 320.0;
constexpr double kShrink = 0.75;
constexpr std::size_t kMostDots = 1600;

Eigen::Vector3f to_eigen(const Vec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

double radius_of(const Ball& ball) {
  return kShrink * std::cbrt(0.75 * ball.volume / std::numbers::pi);
}

void add_ball(std::string& svg, const Ball& ball, const Eigen::Vector2f& at, double radius) {
  const Color c = part_color(ball.color);
  if (ball.hollow) {
    fmt::format_to(std::back_inserter(svg),
                   "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"none\" "
                   "stroke=\"#3a3e46\" stroke-width=\"1.6\" stroke-dasharray=\"4 3\"/>\n",
                   at.x(), at.y(), radius);
    return;
  }
  fmt::format_to(std::back_inserter(svg),
                 "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"{2:.1f}\" fill=\"rgb({3},{4},{5})\"/>"
                 "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"{2:.1f}\" fill=\"url(#light)\"/>\n",
                 at.x(), at.y(), radius, c[0], c[1], c[2]);
}

}  // namespace

std::vector<Ball> balls_of(const Parts& parts) {
  std::vector<Ball> balls;
  for (const Part& part : parts.parts) {
    balls.push_back(
        {.center = part.center, .volume = part.volume, .color = static_cast<int>(balls.size())});
  }
  return balls;
}

std::vector<Ball> balls_on_target(const Match& match, const Parts& source) {
  const auto& m = match.target_from_source;
  const double scale = std::hypot(m[0], m[4], m[8]);
  std::vector<Vec3> centers;
  for (const Part& part : source.parts) centers.push_back(part.center);
  centers = on_target(match, centers);
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    balls.push_back({.center = centers[i],
                     .volume = scale * scale * scale * source.parts[i].volume,
                     .hollow = true});
  }
  return balls;
}

std::string draw_balls(std::span<const Vec3> points, std::vector<Ball> balls) {
  std::vector<Eigen::Vector3f> all;
  for (const Vec3& p : points) all.push_back(to_eigen(p));
  const Eigen::Matrix3f view = picture::choose_views(all, 1).front();
  Eigen::Vector2f low(1e30F, 1e30F);
  Eigen::Vector2f high = -low;
  const auto include = [&](const Vec3& p, double radius) {
    const Eigen::Vector2f at = (view * to_eigen(p)).head<2>();
    const auto reach = static_cast<float>(radius);
    low = low.cwiseMin(at - Eigen::Vector2f(reach, reach));
    high = high.cwiseMax(at + Eigen::Vector2f(reach, reach));
  };
  for (const Vec3& p : points) include(p, 0.0);
  for (const Ball& ball : balls) include(ball.center, radius_of(ball));
  const float scale = static_cast<float>(kSize) / (high - low).maxCoeff();
  const auto place = [&](const Vec3& p) {
    const Eigen::Vector2f at = (view * to_eigen(p)).head<2>();
    return Eigen::Vector2f(4.0F + scale * (at.x() - low.x()), 4.0F + scale * (high.y() - at.y()));
  };

  const Eigen::Vector2f size = scale * (high - low) + Eigen::Vector2f(8.0F, 8.0F);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\">\n"
      "<radialGradient id=\"light\" cx=\"0.35\" cy=\"0.3\" r=\"0.8\"><stop offset=\"0\" "
      "stop-color=\"#fff\" stop-opacity=\"0.6\"/><stop offset=\"0.5\" stop-color=\"#fff\" "
      "stop-opacity=\"0\"/><stop offset=\"1\" stop-color=\"#000\" stop-opacity=\"0.35\"/>"
      "</radialGradient>\n"
      "<path stroke=\"#9aa5b1\" stroke-width=\"1.4\" stroke-linecap=\"round\" d=\"",
      size.x(), size.y());
  const std::size_t step = std::max<std::size_t>(1, points.size() / kMostDots);
  for (std::size_t i = 0; i < points.size(); i += step) {
    const Eigen::Vector2f at = place(points[i]);
    fmt::format_to(std::back_inserter(svg), "M{:.0f} {:.0f}h0", at.x(), at.y());
  }
  svg += "\"/>\n";
  const auto depth = [&](const Ball& ball) { return (view * to_eigen(ball.center)).z(); };
  std::ranges::stable_sort(balls, [&](const Ball& a, const Ball& b) {
    return a.hollow != b.hollow ? b.hollow : depth(a) < depth(b);
  });
  for (const Ball& ball : balls) {
    add_ball(svg, ball, place(ball.center), static_cast<double>(scale) * radius_of(ball));
  }
  return svg + "</svg>\n";
}

}  // namespace morsel::reproduce
