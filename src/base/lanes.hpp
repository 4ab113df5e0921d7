// Four numbers side by side. Each operation is rounded as for one alone, so results are the same on
// every machine, whatever it has for vectors.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace morsel {

// Of GCC and clang: + - * / and comparisons work lane by lane.
using Lanes = float __attribute__((vector_size(16)));
using LaneBits = std::uint32_t __attribute__((vector_size(16)));

/// A place or direction in floats, read into lanes at once.
struct alignas(16) Spot {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  float unused = 0.0F;
};

/// Four places or directions.
struct Lanes3 {
  Lanes x, y, z;
};

[[nodiscard]] inline Lanes all_lanes(float value) { return Lanes{value, value, value, value}; }
[[nodiscard]] inline Lanes3 all_lanes(const Spot& spot) {
  return {all_lanes(spot.x), all_lanes(spot.y), all_lanes(spot.z)};
}

/// Those of `spots` that four indices name.
[[nodiscard]] inline Lanes3 gather(const Spot* spots, const std::uint32_t* indices) {
  const auto a = std::bit_cast<Lanes>(spots[indices[0]]);
  const auto b = std::bit_cast<Lanes>(spots[indices[1]]);
  const auto c = std::bit_cast<Lanes>(spots[indices[2]]);
  const auto d = std::bit_cast<Lanes>(spots[indices[3]]);
  const Lanes ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);  // x x y y
  const Lanes cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Lanes ab_z = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Lanes cd_z = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {__builtin_shufflevector(ab, cd, 0, 1, 4, 5), __builtin_shufflevector(ab, cd, 2, 3, 6, 7),
          __builtin_shufflevector(ab_z, cd_z, 0, 1, 4, 5)};
}

[[nodiscard]] inline Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline constexpr std::uint32_t kSignBit = 0x80000000U;

[[nodiscard]] inline Lanes abs(Lanes a) {
  return std::bit_cast<Lanes>(std::bit_cast<LaneBits>(a) & ~kSignBit);
}
/// `a`, negated where `sign` is negative.
[[nodiscard]] inline Lanes with_sign(Lanes a, Lanes sign) {
  return std::bit_cast<Lanes>(std::bit_cast<LaneBits>(a) ^
                              (std::bit_cast<LaneBits>(sign) & kSignBit));
}
[[nodiscard]] inline Lanes not_negative(Lanes a) { return a > 0.0F ? a : all_lanes(0.0F); }

[[nodiscard]] inline float sum(Lanes a) { return (a[0] + a[1]) + (a[2] + a[3]); }

}  // namespace morsel
