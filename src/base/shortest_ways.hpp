// Shortest ways along the edges of a graph.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace morsel {

/// For each vertex where its edges lead and how long they are, >= 0.
using Graph = std::vector<std::vector<std::pair<std::uint32_t, double>>>;

/// From one vertex to all others; infinite where there is no way. Cost: O(e log e) for e edges.
/// Source: E. W. Dijkstra, "A Note on Two Problems in Connexion with Graphs", Numerische
/// Mathematik 1, 1959.
[[nodiscard]] std::vector<double> shortest_ways(const Graph& graph, std::uint32_t from);

}  // namespace morsel
