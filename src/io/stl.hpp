// What format detection needs to know about STL.
#pragma once

#include "io/source.hpp"

namespace morsel::io {

/// True when the size of the file is exactly that of a binary STL with the number of triangles that
/// its header states: no text is taken for one, and a binary STL may begin with "solid".
[[nodiscard]] bool has_binary_stl_size(const Source& source);

}  // namespace morsel::io
