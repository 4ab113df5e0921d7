#include "plane/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <morsel/color.hpp>

namespace morsel::plane {
namespace {

constexpr double kWidth = 480.0;
constexpr const char* kInk = "#3a3e46";

std::string hex(const Color& c) { return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]); }

// Part of the plane, scaled to the width of a picture, y upward.
class Canvas {
 public:
  Canvas(const Point& low, const Point& high)
      : low_(low), high_(high), scale_(kWidth / (high.x - low.x)) {
    fmt::format_to(std::back_inserter(text_),
                   "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" "
                   "stroke-linejoin=\"round\" stroke-linecap=\"round\">\n",
                   kWidth, scale_ * (high.y - low.y));
  }

  void open(const std::string& style) { text_ += "<g " + style + ">\n"; }
  void close() { text_ += "</g>\n"; }
  void circle(const Point& center, double radius) {
    const auto [x, y] = place(center);
    fmt::format_to(std::back_inserter(text_),
                   "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n", x, y, scale_ * radius);
  }
  void dot(const Point& center, double pixels) { circle(center, pixels / scale_); }
  void polygon(const std::vector<Point>& corners, const std::string& style = {}) {
    draw("polygon", corners, style);
  }
  void polyline(const std::vector<Point>& corners, const std::string& style = {}) {
    draw("polyline", corners, style);
  }
  [[nodiscard]] std::string take() { return std::move(text_) + "</svg>\n"; }

 private:
  [[nodiscard]] Point place(const Point& p) const {
    return {scale_ * (p.x - low_.x), scale_ * (high_.y - p.y)};
  }
  void draw(const char* what, const std::vector<Point>& corners, const std::string& style) {
    text_ += fmt::format("<{} points=\"", what);
    for (const Point& corner : corners) {
      const auto [x, y] = place(corner);
      fmt::format_to(std::back_inserter(text_), "{:.1f},{:.1f} ", x, y);
    }
    text_.back() = '"';
    text_ += style.empty() ? "/>\n" : " " + style + "/>\n";
  }

  Point low_;
  Point high_;
  double scale_;
  std::string text_;
};

Canvas canvas_of(const Shape& shape) {
  Point low = shape.points[0];
  Point high = low;
  for (const Point& p : shape.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double margin = 0.06 * (high.x - low.x);
  return {{low.x - margin, low.y - margin}, {high.x + margin, high.y + margin}};
}

std::vector<Point> corners_of(const Shape& shape, std::size_t triangle) {
  const auto& [a, b, c] = shape.triangles[triangle].corners;
  return {shape.points[a], shape.points[b], shape.points[c]};
}

void add_points(Canvas& canvas, const Shape& shape) {
  canvas.open(fmt::format("fill=\"{}\"", kInk));
  for (const Point& p : shape.points) canvas.dot(p, 1.3);
  canvas.close();
}

std::string draw_triangulation(const Shape& shape) {
  Canvas canvas = canvas_of(shape);
  canvas.open("fill=\"none\" stroke=\"#8fa3b8\" stroke-width=\"0.6\"");
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) canvas.polygon(corners_of(shape, i));
  canvas.close();
  add_points(canvas, shape);
  return canvas.take();
}

void add_balls(Canvas& canvas, const Shape& shape, const std::vector<bool>& which) {
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    if (which[i]) canvas.circle(shape.triangles[i].center, shape.triangles[i].radius);
  }
  canvas.close();
}

std::string draw_balls(const Shape& shape) {
  Canvas canvas = canvas_of(shape);
  std::vector<bool> small = shape.big;
  small.flip();
  canvas.open("fill=\"none\" stroke=\"#5b8db8\" stroke-width=\"0.5\" stroke-opacity=\"0.7\"");
  add_balls(canvas, shape, shape.big);
  canvas.open("fill=\"#d55e00\" fill-opacity=\"0.25\" stroke=\"#d55e00\" stroke-width=\"0.7\"");
  add_balls(canvas, shape, small);
  return canvas.take();
}

std::string draw_union(const Shape& shape) {
  Canvas canvas = canvas_of(shape);
  canvas.open("fill=\"#9cc7ea\"");
  add_balls(canvas, shape, shape.inner);
  add_points(canvas, shape);
  return canvas.take();
}

std::string draw_maxima(const Shape& shape) {
  Canvas canvas = canvas_of(shape);
  canvas.open("fill=\"#e4edf5\" stroke=\"#8fa3b8\" stroke-width=\"0.5\"");
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    if (shape.inner[i]) canvas.polygon(corners_of(shape, i));
  }
  canvas.close();
  canvas.open("fill=\"#0072b2\" stroke=\"#0072b2\" stroke-width=\"0.5\"");
  for (const std::uint32_t i : shape.maxima) canvas.polygon(corners_of(shape, i));
  canvas.close();
  add_points(canvas, shape);
  return canvas.take();
}

std::string draw_regions(const Shape& shape, bool merged) {
  Canvas canvas = canvas_of(shape);
  canvas.open("stroke-width=\"0.6\"");
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    const std::uint32_t basin = shape.basin[i];
    if (basin == kNone) continue;
    const std::string color = hex(part_color(merged ? shape.part[basin] : static_cast<int>(basin)));
    canvas.polygon(corners_of(shape, i), fmt::format("fill=\"{0}\" stroke=\"{0}\"", color));
  }
  canvas.close();
  add_points(canvas, shape);
  return canvas.take();
}

// From the edge's middle over the centres of the balls, each larger than the one before.
std::vector<Point> line_along(const Shape& shape, const Point& from,
                              const std::vector<std::uint32_t>& way) {
  std::vector<Point> line{from};
  for (const std::uint32_t triangle : way) line.push_back(shape.triangles[triangle].center);
  return line;
}

}  // namespace

std::vector<std::string> draw_steps(const Shape& shape) {
  return {draw_triangulation(shape), draw_balls(shape),          draw_union(shape),
          draw_maxima(shape),        draw_regions(shape, false), draw_regions(shape, true)};
}

std::string draw_saddle(const Shape& shape, const Saddle& saddle) {
  const Triangle& one = shape.triangles[saddle.maxima[0]];
  const Triangle& other = shape.triangles[saddle.maxima[1]];
  Point low = one.center;
  Point high = one.center;
  for (const Triangle* t : {&one, &other}) {
    const double reach = 1.25 * t->radius;
    low = {std::min(low.x, t->center.x - reach), std::min(low.y, t->center.y - reach)};
    high = {std::max(high.x, t->center.x + reach), std::max(high.y, t->center.y + reach)};
  }
  Canvas canvas(low, high);
  const std::array<const char*, 2> colors{"#cfe3f4", "#fbe0c3"};
  for (std::size_t side = 0; side < 2; ++side) {
    canvas.open(fmt::format("fill=\"{0}\" stroke=\"{0}\" stroke-width=\"0.6\"", colors[side]));
    for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
      const std::uint32_t basin = shape.basin[i];
      if (basin != kNone && shape.maxima[basin] == saddle.maxima[side]) {
        canvas.polygon(corners_of(shape, i));
      }
    }
    canvas.close();
  }
  canvas.open("fill=\"none\" stroke=\"#5b8db8\" stroke-width=\"1.2\" stroke-dasharray=\"5 4\"");
  canvas.circle(one.center, one.radius);
  canvas.circle(other.center, other.radius);
  canvas.close();
  const Point& a = shape.points[saddle.ends[0]];
  const Point& b = shape.points[saddle.ends[1]];
  const Point middle{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
  canvas.open("fill=\"none\" stroke-width=\"2.5\"");
  for (const auto& way : saddle.ways) {
    canvas.polyline(line_along(shape, middle, way), "stroke=\"#0072b2\"");
  }
  canvas.polyline({a, b}, "stroke=\"#d55e00\"");
  canvas.close();
  add_points(canvas, shape);
  canvas.open("fill=\"#0072b2\"");
  canvas.dot(one.center, 5.0);
  canvas.dot(other.center, 5.0);
  canvas.close();
  canvas.open("fill=\"#d55e00\"");
  canvas.dot(middle, 5.0);
  canvas.close();
  return canvas.take();
}

}  // namespace morsel::plane
