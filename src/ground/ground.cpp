#include "ground/ground.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "base/box.hpp"
#include "ground/contact.hpp"
#include "ground/plane.hpp"

namespace morsel {
namespace {

// Planes are looked for among so many points at most.
constexpr std::size_t kSample = 4096;
// So many planes may bear more points than the ground.
constexpr int kPlanes = 3;
// In the order of GroundMode.
constexpr std::array<std::string_view, 3> kModeNames{"auto", "keep", "remove"};

std::optional<GroundPlane> choose_plane(const std::vector<Vec3>& points, GroundMode mode) {
  const std::vector<Vec3> sample = evenly_chosen(points, kSample);
  const double diagonal = bounding_box(sample).diagonal();
  std::vector<Vec3> left = sample;
  for (int i = 0; i < kPlanes; ++i) {
    const std::optional<GroundPlane> plane = find_plane(left, diagonal);
    if (!plane || mode == GroundMode::kRemove) return plane;
    if (is_unmistakable(sample, *plane, diagonal)) return plane;
    std::erase_if(left,
                  [&](const Vec3& p) { return std::abs(plane->height(p)) <= plane->thickness; });
  }
  return std::nullopt;
}

}  // namespace

std::string_view ground_mode_name(GroundMode mode) {
  return kModeNames[static_cast<std::size_t>(mode)];
}

std::optional<GroundMode> ground_mode_named(std::string_view name) {
  const auto* const at = std::ranges::find(kModeNames, name);
  if (at == kModeNames.end()) return std::nullopt;
  return static_cast<GroundMode>(at - kModeNames.begin());
}

std::size_t Ground::count_apart() const {
  return static_cast<std::size_t>(std::ranges::count(apart, char{1}));
}

Ground find_ground(std::span<const Vec3> points, const GroundOptions& options) {
  if (options.mode == GroundMode::kKeep) return {};
  return find_ground(sort_spatially(points, options.threads), options);
}

Ground find_ground(const SpatialOrder& order, const GroundOptions& options) {
  Ground ground;
  if (options.mode == GroundMode::kKeep) return ground;
  ground.plane = choose_plane(order.points, options.mode);
  if (!ground.plane) return ground;
  Contact contact = find_contact(order.points, *ground.plane, options.threads);
  if (std::ranges::count(contact.apart, char{0}) == 0) return {};  // nothing stands on it
  ground.base = std::move(contact.base);
  for (const std::uint32_t i : order.order_of_point) ground.apart.push_back(contact.apart[i]);
  return ground;
}

}  // namespace morsel
