#include <cstddef>

#include "serve/app_page.hpp"

namespace morsel::serve {

std::string policy_of(std::string_view page) {
  constexpr std::string_view kMark = "<meta http-equiv=\"Content-Security-Policy\" content=\"";
  const std::size_t mark = page.find(kMark);
  if (mark == std::string_view::npos) return "default-src 'none'; frame-ancestors 'none'";
  const std::size_t begin = mark + kMark.size();
  const std::size_t end = page.find('"', begin);
  return std::string(page.substr(begin, end - begin)) + "; frame-ancestors 'none'";
}

}  // namespace morsel::serve
