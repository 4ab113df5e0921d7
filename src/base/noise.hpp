// Gaussian noise on points.
#pragma once

#include <morsel/vec3.hpp>
#include <span>

#include "base/random.hpp"

namespace morsel {

/// Moves each point by independent noise of standard deviation `sigma` along x, y and z.
inline void add_noise(std::span<Vec3> points, double sigma, Random& random) {
  for (Vec3& p : points) {
    const double x = random.normal();
    const double y = random.normal();
    p = p + sigma * Vec3{x, y, random.normal()};
  }
}

}  // namespace morsel
