// morsel-bench: how well a ranking by scores brings shapes of one class together.
//
// Source: P. Shilane, P. Min, M. Kazhdan, T. Funkhouser, "The Princeton Shape Benchmark", SMI 2004,
// section 4.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace morsel::bench {

/// Means over the queries whose class has another member.
struct Retrieval {
  double nearest = 0.0;      ///< share of best hits of the query's class
  double first_tier = 0.0;   ///< share of the class among the C - 1 best hits
  double second_tier = 0.0;  ///< among the 2 (C - 1) best
  double gain = 0.0;         ///< discounted cumulative gain over that of the ideal ranking
};

/// `scores` is (queries, n) row-major; `queries` says which of the n stored shapes each row's query
/// is, and that one is passed over. Higher is better, ties by index.
[[nodiscard]] Retrieval rank(std::span<const double> scores,
                             std::span<const std::string> categories,
                             std::span<const std::size_t> queries);

/// Adds the four measures to a JSON object, by name.
void add_measures(const Retrieval& retrieval, nlohmann::ordered_json& json);

}  // namespace morsel::bench
