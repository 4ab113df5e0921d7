// Bad values in arrays, told apart from bad files.
#pragma once

#include <morsel/error.hpp>
#include <utility>

namespace morsel::python {

/// Becomes a ValueError.
class BadValue : public Error {
 public:
  explicit BadValue(const Error& error) : Error(error) {}
};

/// Runs work on arrays alone: an Error(kInput) is about a value in them, not about a file.
template <class Work>
auto on_values(const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kInput) throw BadValue(error);
    throw;
  }
}

}  // namespace morsel::python
