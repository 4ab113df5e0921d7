// Options of the library from plain values of Python.
#pragma once

#include <morsel/match.hpp>
#include <morsel/morsel.hpp>
#include <optional>
#include <string>

namespace morsel::python {

/// "default" or "paper". Throws Error(kUsage).
[[nodiscard]] Method method_of(const std::string& name);

/// Throws Error(kUsage), also for a mode that the method lacks.
[[nodiscard]] MatchOptions match_options(const std::string& method, const std::string& mode,
                                         bool mirror, bool same_scale = false);

/// How to segment; the cut is set apart. `denoise` none: the program decides. `ground` is
/// "auto", "keep" or "remove".
/// Throws Error(kUsage) that names the value and its range.
[[nodiscard]] SegmentOptions segment_options(const std::string& method, std::optional<int> denoise,
                                             const std::string& ground, int threads);

}  // namespace morsel::python
