// How much memory there was, and whether there is enough for what is to come.
#pragma once

#include <cstddef>
#include <string>

namespace morsel {

/// The most bytes that this process has held at a time.
[[nodiscard]] std::size_t peak_memory();

/// Bytes that this process can still have: what the system says is available or, if less, what is
/// left of the process's own limit (ulimit -v). The largest value where neither is known.
[[nodiscard]] std::size_t available_memory();

/// Throws Error(kResource) that names both figures and what the memory is for, as in "triangulating
/// 5 points", when `needed` bytes are more than `available`.
void expect_memory(std::size_t needed, std::size_t available, const std::string& what);

}  // namespace morsel
