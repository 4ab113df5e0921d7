// Order statistics.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace morsel {

/// The value below which `share` (0 … 1) of the values lie; 0 of none. Cost: O(n).
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace morsel
