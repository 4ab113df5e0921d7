// The smallest program that uses an installed morsel: the parts of a ball's points.
#include <cmath>
#include <iostream>
#include <morsel/morsel.hpp>
#include <vector>

int main() {
  std::vector<morsel::Vec3> points;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kCount;
    const double angle = 2.399963 * i;
    const double radius = std::sqrt(1.0 - z * z);
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
  }
  const morsel::Segmentation result = morsel::segment(points);
  std::cout << "consumer: morsel " << morsel::version() << ": " << result.message << '\n';
  return result.parts.parts.size() == 1 && result.labels.size() == points.size() ? 0 : 1;
}
