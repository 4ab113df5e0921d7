#include "suggest.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace morsel::cli {
namespace {

// Levenshtein distance: letters to insert, delete or replace.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(const std::string& typed, const std::vector<std::string>& known) {
  // An abbreviation is far in letters but plain in meaning; "--" alone abbreviates everything.
  constexpr std::size_t kLeastPrefix = 4;
  std::string best;
  std::size_t least = std::max<std::size_t>(2, typed.size() / 3) + 1;
  for (const std::string& name : known) {
    const bool abbreviated = typed.size() >= kLeastPrefix && name.starts_with(typed);
    const std::size_t away = abbreviated ? 0 : edit_distance(typed, name);
    if (away < least) {
      least = away;
      best = name;
    }
  }
  return best;
}

}  // namespace morsel::cli
