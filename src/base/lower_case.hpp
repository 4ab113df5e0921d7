// Text without the difference of capitals.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

namespace morsel {

/// ASCII letters in lower case, all else as it is.
[[nodiscard]] inline std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace morsel
