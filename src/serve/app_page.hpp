// The web app as web/ builds it, held by the library.
#pragma once

#include <string>
#include <string_view>

namespace morsel::serve {

/// One page with script and style; empty when the library was built without it.
[[nodiscard]] std::string_view app_page() noexcept;

/// The content-security policy that the page names in its head, for the answer's header, with what
/// a page cannot say itself.
[[nodiscard]] std::string policy_of(std::string_view page);

}  // namespace morsel::serve
