// The viewer as web/ builds it, held by the library.
#pragma once

#include <string_view>

namespace morsel {

/// Stands in the viewer's page where the shape goes; occurs once.
inline constexpr std::string_view kShapeMark = "@MORSEL_SHAPE@";

/// The page without a shape; empty when the library was built without it.
[[nodiscard]] std::string_view viewer_page() noexcept;

}  // namespace morsel
