// morsel-bench: a folder of files into a database.
#pragma once

#include <cstddef>
#include <functional>
#include <morsel/vec3.hpp>
#include <nlohmann/json.hpp>
#include <vector>

namespace morsel::bench {

/// Triangulates points by CGAL alone.
using Triangulate = std::function<void(const std::vector<Vec3>& points)>;

/// Writes `files` PLY files of 20,000 points each, generated shapes, every second with noise of
/// 0.3%, a `runs`-th of them a run. In each run, all in processes of their own and in turns: reads
/// and triangulates them one after the other; indexes them with one thread, and with all. Of each
/// seconds waited for and seconds of the cores, a file.
/// Throws Error(kOutput), Error(kResource).
[[nodiscard]] nlohmann::ordered_json measure_indexing(std::size_t files, std::size_t runs,
                                                      const Triangulate& triangulate);

/// Medians over the runs of what measure_indexing() returned.
void print_indexing(const nlohmann::ordered_json& measured);

}  // namespace morsel::bench
