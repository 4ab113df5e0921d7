// Sorting of many values by a number of which much is known.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/threads.hpp"

namespace morsel {

/// Sorts fewer than 2^32 values by operator<, which must tell any two different ones apart, for one
/// result in every run. bucket(value), below `buckets`, never falls along that order: the better it
/// spreads the values, the less is left to compare.
template <typename Value, typename Bucket>
void bucket_sort(std::vector<Value>& values, std::size_t buckets, int threads,
                 const Bucket& bucket) {
  std::vector<std::uint32_t> ends(buckets + 1, 0);
  in_turn(values.size(), [&](std::size_t i) { ++ends[bucket(values[i]) + 1]; });
  for (std::size_t b = 0; b < buckets; ++b) ends[b + 1] += ends[b];
  // ends[b] now is the begin of b and becomes its end while the values are put there.
  std::vector<Value> sorted(values.size());
  in_turn(values.size(), [&](std::size_t i) { sorted[ends[bucket(values[i])]++] = values[i]; });
  const auto at = [&](std::uint32_t i) { return sorted.begin() + i; };
  parallel_ranges(buckets, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      std::sort(at(b == 0 ? 0 : ends[b - 1]), at(ends[b]));
    }
  });
  values = std::move(sorted);
}

/// Spreads positive numbers over kSizeBuckets, larger ones first: those within a thousandth of
/// each other share one, as do all below 1/256 and all above 256.
inline constexpr std::size_t kSizeBuckets = 16 * 1024 + 1;
[[nodiscard]] inline std::size_t size_bucket(double value) {
  constexpr float kLargest = 256.0F;
  constexpr int kDropped = 13;  // of a float's 23 bits after the point
  // In this order what is no number is small.
  const float rounded = std::min(std::max(1.0F / kLargest, static_cast<float>(value)), kLargest);
  return (std::bit_cast<std::uint32_t>(kLargest) - std::bit_cast<std::uint32_t>(rounded)) >>
         kDropped;
}

}  // namespace morsel
