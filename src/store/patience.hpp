// Work that is tried again when the connection to the database was lost.
#pragma once

#include <chrono>
#include <optional>

#include "store/connection.hpp"

namespace morsel::store {

/// For how long a server that went away is waited for.
inline constexpr std::chrono::seconds kPatience{30};

/// Waits between attempts, longer each time.
class Patience {
 public:
  /// Throws Error(kOutput) with what `lost` says when kPatience has passed since the first call.
  void wait(const LostConnection& lost);

 private:
  std::optional<std::chrono::steady_clock::time_point> began_;
  std::chrono::milliseconds pause_{50};
};

/// Calls work(); when the connection is lost, connects anew and calls it again.
template <class Work>
auto patiently(Connection& connection, const Work& work) {
  Patience patience;
  for (bool lost = false;; lost = true) {
    try {
      if (lost) connection.reconnect();
      return work();
    } catch (const LostConnection& error) {
      patience.wait(error);
    }
  }
}

}  // namespace morsel::store
