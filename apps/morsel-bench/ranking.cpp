#include "ranking.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace morsel::bench {
namespace {

// The worth of a hit at rank 0, 1, ….
double discount(std::size_t rank) {
  return rank == 0 ? 1.0 : 1.0 / std::log2(static_cast<double>(rank + 1));
}

void add_query(const std::vector<bool>& relevant, std::size_t others, Retrieval& sum) {
  double gain = 0.0;
  double ideal = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (std::size_t i = 0; i < relevant.size(); ++i) {
    if (i < others) ideal += discount(i);
    if (!relevant[i]) continue;
    gain += discount(i);
    if (i < others) first += 1.0;
    if (i < 2 * others) second += 1.0;
  }
  sum.nearest += relevant[0] ? 1.0 : 0.0;
  sum.first_tier += first / static_cast<double>(others);
  sum.second_tier += second / static_cast<double>(others);
  sum.gain += gain / ideal;
}

}  // namespace

Retrieval rank(std::span<const double> scores, std::span<const std::string> categories,
               std::span<const std::size_t> queries) {
  const std::size_t count = categories.size();
  Retrieval sum;
  std::size_t counted = 0;
  for (std::size_t row = 0; row < queries.size(); ++row) {
    const std::size_t query = queries[row];
    const auto same = static_cast<std::size_t>(std::ranges::count(categories, categories[query]));
    if (same < 2) continue;
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    order.erase(order.begin() + static_cast<std::ptrdiff_t>(query));
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::size_t i) { return scores[row * count + i]; });
    std::vector<bool> relevant;
    for (const std::size_t i : order) relevant.push_back(categories[i] == categories[query]);
    add_query(relevant, same - 1, sum);
    ++counted;
  }
  const double share = counted > 0 ? 1.0 / static_cast<double>(counted) : 0.0;
  return {share * sum.nearest, share * sum.first_tier, share * sum.second_tier, share * sum.gain};
}

void add_measures(const Retrieval& retrieval, nlohmann::ordered_json& json) {
  json["nearest_neighbor"] = retrieval.nearest;
  json["first_tier"] = retrieval.first_tier;
  json["second_tier"] = retrieval.second_tier;
  json["discounted_gain"] = retrieval.gain;
}

}  // namespace morsel::bench
