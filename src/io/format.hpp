// Which format a file is in: by its content first, then by its extension.
#pragma once

#include "io/source.hpp"

namespace morsel::io {

enum class Format { kText, kPly, kPcd, kNpy, kLas, kOff, kObj, kStl, kGltf };

/// Throws Error(kInput) for an empty file, and, naming what was found, for content that no reader
/// takes or that contradicts the extension.
[[nodiscard]] Format detect_format(const Source& source);

}  // namespace morsel::io
