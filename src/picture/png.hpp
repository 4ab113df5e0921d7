// An image as the bytes of a PNG file.
#pragma once

#include <morsel/picture.hpp>
#include <string>

namespace morsel::picture {

/// Throws Error(kUsage) for an image without pixels or with another number of bytes than its size
/// says; `name` stands for it in messages.
[[nodiscard]] std::string encode_png(const Image& image, const std::string& name);

}  // namespace morsel::picture
