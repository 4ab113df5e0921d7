// Bytes as text: base64 with padding, RFC 4648 section 4.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace morsel {

[[nodiscard]] std::string encode_base64(std::string_view bytes);

/// Nothing when `text` holds a character that is not base64's; padding may be left out.
[[nodiscard]] std::optional<std::string> decode_base64(std::string_view text);

}  // namespace morsel
