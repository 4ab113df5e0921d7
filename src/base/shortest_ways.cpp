#include "base/shortest_ways.hpp"

#include <functional>
#include <limits>
#include <queue>

namespace morsel {

std::vector<double> shortest_ways(const Graph& graph, std::uint32_t from) {
  std::vector<double> length(graph.size(), std::numeric_limits<double>::infinity());
  using Step = std::pair<double, std::uint32_t>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
  length[from] = 0.0;
  open.emplace(0.0, from);
  while (!open.empty()) {
    const auto [way, at] = open.top();
    open.pop();
    if (way > length[at]) continue;
    for (const auto& [next, step] : graph[at]) {
      if (way + step >= length[next]) continue;
      length[next] = way + step;
      open.emplace(length[next], next);
    }
  }
  return length;
}

}  // namespace morsel
