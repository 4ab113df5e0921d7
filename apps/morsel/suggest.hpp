// What a mistyped option or command was likely meant to be.
#pragma once

#include <string>
#include <vector>

namespace morsel::cli {

/// The one of `known` that is nearest to `typed` in spelling, or "" when none is near.
[[nodiscard]] std::string nearest_name(const std::string& typed,
                                       const std::vector<std::string>& known);

}  // namespace morsel::cli
