// morsel: the one exception type of the library.
#pragma once

#include <stdexcept>
#include <string>

namespace morsel {

/// What kind of contract was broken; the command line maps each to an exit status.
enum class ErrorCode {
  kUsage,      ///< an option or argument is outside its documented range
  kInput,      ///< an input file or array cannot be used as it is
  kOutput,     ///< a result cannot be written
  kResource,   ///< memory or another resource cannot be had
  kCancelled,  ///< the caller's Progress asked to stop
  kInternal,   ///< a bug in morsel
};

/// Thrown for broken contracts, I/O and resources. `what()` is one line that names the file, line,
/// index or value and says what would be right. Expected geometric outcomes (a flat cloud, an open
/// shape) are values in the results, never an Error.
class Error : public std::runtime_error {
 public:
  /// `message` is one line without a full stop at its end.
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

  /// What kind of contract was broken.
  [[nodiscard]] ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace morsel
