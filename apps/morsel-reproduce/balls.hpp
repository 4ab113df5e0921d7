// morsel-reproduce: representative points as balls, Figure 4 of the paper.
#pragma once

#include <morsel/match.hpp>
#include <morsel/segment.hpp>
#include <morsel/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace morsel::reproduce {

/// A representative point of a part.
struct Ball {
  Vec3 center;
  double volume = 0.0;
  int color = 0;        ///< part_color()
  bool hollow = false;  ///< drawn as a ring: of the other one of two shapes
};

/// One a part.
[[nodiscard]] std::vector<Ball> balls_of(const Parts& parts);

/// Those of a source where they lie on the target, hollow.
[[nodiscard]] std::vector<Ball> balls_on_target(const Match& match, const Parts& source);

/// An SVG of the balls, each of the volume's size shrunk to three quarters, before the points of
/// the shape, seen as write_picture() shows `points` first.
[[nodiscard]] std::string draw_balls(std::span<const Vec3> points, std::vector<Ball> balls);

}  // namespace morsel::reproduce
