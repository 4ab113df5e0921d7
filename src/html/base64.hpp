// Bytes as text.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace morsel {

/// RFC 4648, with padding.
[[nodiscard]] std::string encode_base64(std::span<const std::byte> bytes);

}  // namespace morsel
