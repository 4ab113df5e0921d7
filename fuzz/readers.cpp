// Files of points and meshes.

#include <morsel/io.hpp>
#include <utility>
#include <variant>

#include "targets.hpp"

namespace morsel::fuzz {

void run_reader(std::string_view name, std::string bytes) {
  const SampleOptions few{.count = 20};
  accepts([&] {
    const PointCloud cloud = parse_points(std::move(bytes), "fuzz." + std::string(name), few);
    require(!cloud.points.empty(), "what is read has points");
    for (const Vec3& point : cloud.points) require(is_finite(point), "points are finite");
    for (const PointProperty& property : cloud.properties) {
      const auto count =
          std::visit([](const auto& values) { return values.size(); }, property.values);
      require(count == cloud.points.size(), "a property has a value a point");
    }
  });
}

}  // namespace morsel::fuzz
