// Signatures as bytes.
#pragma once

#include <morsel/signature.hpp>
#include <string_view>

namespace morsel::python {

/// Throws Error(kInput) for bytes that encode() did not write.
[[nodiscard]] Signature signature_of(std::string_view bytes);

}  // namespace morsel::python
