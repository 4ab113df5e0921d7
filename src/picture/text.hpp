// Plain text in pictures, drawn with a small stroke font.
#pragma once

#include <cstddef>
#include <morsel/picture.hpp>
#include <string>
#include <string_view>

namespace morsel::picture {

inline constexpr Color kTextColor{58, 62, 70};

/// Width in pixels of text whose capitals are 3/4 of `size` pixels high.
[[nodiscard]] float text_width(std::string_view text, float size);

/// The text, shortened with "..." if it is wider than `width` pixels.
[[nodiscard]] std::string fit_text(std::string_view text, float size, float width);

/// Draws antialiased text whose baseline starts at (left, baseline). Printable ASCII; every other
/// character becomes a question mark. What lies outside the image is not drawn.
void draw_text(Image& image, std::string_view text, float left, float baseline, float size);

}  // namespace morsel::picture
