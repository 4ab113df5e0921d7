// A collection of shapes in seventeen classes, those of the paper's matrix, out of simple bodies:
// for whoever has no benchmark at hand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "solids/solid.hpp"

namespace morsel::solids {

/// The names of the families, in the order of the paper.
[[nodiscard]] std::span<const std::string_view> family_names();

/// Which shape of a family.
struct Member {
  std::size_t family = 0;    ///< index into family_names()
  std::uint64_t number = 0;  ///< proportions; any number
  std::uint64_t pose = 0;    ///< of the limbs, where it has joints; any number
};

/// Upright along z, about three units large. Its parts are numbered from 0, the main one first:
/// each leg, wheel, finger a part of its own. The same on every machine.
[[nodiscard]] Solid make_member(const Member& member);

/// Whether `pose` makes a difference.
[[nodiscard]] bool has_joints(std::size_t family);

/// Samples of a member. Those that grow or are bent by hand are bent a little (bend()), machine
/// parts are left straight. The same seed gives the samples of two poses no relation.
[[nodiscard]] LabelledPoints sample_member(const Member& member, const SurfaceOptions& options);

}  // namespace morsel::solids
