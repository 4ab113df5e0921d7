#include "pose.hpp"

#include <cmath>

#include "base/random.hpp"

namespace morsel::bench {

std::vector<Vec3> posed(std::vector<Vec3> points, std::uint64_t seed, bool mirror) {
  constexpr std::uint64_t kPoseStream = 0x706f7365ULL;
  Random random(seed ^ kPoseStream);
  const auto direction = [&random] {
    const double x = random.normal();
    const double y = random.normal();
    const Vec3 v{x, y, random.normal()};
    return (1.0 / norm(v)) * v;
  };
  const Vec3 a = direction();
  const Vec3 across = cross(a, direction());
  const Vec3 b = (1.0 / norm(across)) * across;
  const Vec3 c = (random.below(2) == 0 || !mirror ? 1.0 : -1.0) * cross(a, b);
  const double scale = std::exp(4.0 * random.uniform() - 2.0);
  const Vec3 shift = 10.0 * direction();
  for (Vec3& p : points) p = scale * Vec3{dot(a, p), dot(b, p), dot(c, p)} + shift;
  return points;
}

}  // namespace morsel::bench
