// Sources: W. Lorensen, H. Cline, "Marching cubes", SIGGRAPH 1987 (in two dimensions);
//   D. Douglas, T. Peucker, "Algorithms for the reduction of the number of points", 1973.
#include "picture/contour.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace morsel::picture {
namespace {

using Eigen::Vector2f;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Sides of a square of the grid.
enum Side : std::uint8_t { kTop, kRight, kBottom, kLeft, kNoSide };

struct Step {
  Side from = kNoSide;
  Side to = kNoSide;
};

// The way through a square for each set of inside corners: top left 1, top right 2, bottom right
// 4, bottom left 8. The inside stays on the same hand.
constexpr std::array<std::array<Step, 2>, 16> kSteps{{
    {},
    {{{kLeft, kTop}}},
    {{{kTop, kRight}}},
    {{{kLeft, kRight}}},
    {{{kRight, kBottom}}},
    {{{kLeft, kTop}, {kRight, kBottom}}},
    {{{kTop, kBottom}}},
    {{{kLeft, kBottom}}},
    {{{kBottom, kLeft}}},
    {{{kBottom, kTop}}},
    {{{kTop, kRight}, {kBottom, kLeft}}},
    {{{kBottom, kRight}}},
    {{{kRight, kLeft}}},
    {{{kRight, kTop}}},
    {{{kTop, kLeft}}},
    {},
}};

// Follows the contours through a grid padded by one node on every side, so that all close.
class Tracer {
 public:
  explicit Tracer(const Field& field)
      : field_(field), columns_(field.width + 2), next_(2 * columns_ * (field.height + 2), kNone) {
    for (std::size_t y = 0; y + 1 < field.height + 2; ++y) {
      for (std::size_t x = 0; x + 1 < columns_; ++x) add_square(x, y);
    }
  }

  std::vector<Loop> loops() {
    std::vector<Loop> result;
    for (std::size_t start = 0; start < next_.size(); ++start) {
      if (next_[start] == kNone) continue;
      Loop loop;
      for (auto edge = static_cast<std::uint32_t>(start); next_[edge] != kNone;) {
        loop.push_back(crossing(edge));
        edge = std::exchange(next_[edge], kNone);
      }
      result.push_back(std::move(loop));
    }
    return result;
  }

 private:
  [[nodiscard]] float value(std::size_t x, std::size_t y) const {
    if (x == 0 || y == 0 || x > field_.width || y > field_.height) return -1.0F;
    return field_.values[(y - 1) * field_.width + x - 1];
  }

  // Even numbers are edges to the right of a node, odd ones edges below it.
  [[nodiscard]] std::uint32_t edge_of(std::size_t x, std::size_t y, Side side) const {
    const std::size_t node =
        (y + (side == kBottom ? 1 : 0)) * columns_ + x + (side == kRight ? 1 : 0);
    return static_cast<std::uint32_t>(2 * node + (side == kLeft || side == kRight ? 1 : 0));
  }

  void add_square(std::size_t x, std::size_t y) {
    const std::size_t inside = (value(x, y) > 0.0F ? 1U : 0U) | (value(x + 1, y) > 0.0F ? 2U : 0U) |
                               (value(x + 1, y + 1) > 0.0F ? 4U : 0U) |
                               (value(x, y + 1) > 0.0F ? 8U : 0U);
    for (const Step& step : kSteps[inside]) {
      if (step.from != kNoSide) next_[edge_of(x, y, step.from)] = edge_of(x, y, step.to);
    }
  }

  [[nodiscard]] Vector2f crossing(std::uint32_t edge) const {
    const std::size_t x = edge / 2 % columns_;
    const std::size_t y = edge / 2 / columns_;
    const bool down = edge % 2 == 1;
    const float a = value(x, y);
    const float b = down ? value(x, y + 1) : value(x + 1, y);
    const float t = std::clamp(a / (a - b), 0.0F, 1.0F);
    // Back to the field's own nodes, without the padding.
    return {static_cast<float>(x) - 1.0F + (down ? 0.0F : t),
            static_cast<float>(y) - 1.0F + (down ? t : 0.0F)};
  }

  const Field& field_;
  std::size_t columns_;
  std::vector<std::uint32_t> next_;  // where the contour goes on after crossing an edge
};

float distance_to_line(const Vector2f& p, const Vector2f& a, const Vector2f& b) {
  const Vector2f d = b - a;
  const float square = d.squaredNorm();
  const float t = square > 0.0F ? std::clamp((p - a).dot(d) / square, 0.0F, 1.0F) : 0.0F;
  return (p - a - t * d).norm();
}

// Marks the corners to keep strictly between `first` and `last`.
void keep_between(const Loop& loop, std::size_t first, std::size_t last, float tolerance,
                  std::vector<char>& keep) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    std::size_t farthest = begin;
    float largest = tolerance;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const float distance = distance_to_line(loop[i], loop[begin], loop[end % loop.size()]);
      if (distance <= largest) continue;
      largest = distance;
      farthest = i;
    }
    if (farthest == begin) continue;
    keep[farthest] = 1;
    open.emplace_back(begin, farthest);
    open.emplace_back(farthest, end);
  }
}

}  // namespace

std::vector<Loop> trace_contours(const Field& field) { return Tracer(field).loops(); }

Loop simplify(const Loop& loop, float tolerance) {
  if (loop.size() < 4) return loop;
  std::size_t opposite = 0;
  for (std::size_t i = 1; i < loop.size(); ++i) {
    if ((loop[i] - loop[0]).squaredNorm() > (loop[opposite] - loop[0]).squaredNorm()) opposite = i;
  }
  std::vector<char> keep(loop.size(), 0);
  keep[0] = keep[opposite] = 1;
  keep_between(loop, 0, opposite, tolerance, keep);
  keep_between(loop, opposite, loop.size(), tolerance, keep);
  Loop result;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (keep[i] != 0) result.push_back(loop[i]);
  }
  return result;
}

float signed_area(const Loop& loop) {
  float area = 0.0F;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector2f& a = loop[i];
    const Vector2f& b = loop[(i + 1) % loop.size()];
    area += 0.5F * (a.x() * b.y() - b.x() * a.y());
  }
  return area;
}

}  // namespace morsel::picture
