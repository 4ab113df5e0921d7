// morsel-bench: how long something took.
#pragma once

#include <time.h>

#include <chrono>

namespace morsel::bench {

/// Runs from its construction.
class Stopwatch {
 public:
  /// Waited for.
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  /// That this process had cores for, all threads added: they do not count while others have them.
  [[nodiscard]] double core_seconds() const { return process_seconds() - core_start_; }

 private:
  static double process_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double core_start_ = process_seconds();
};

}  // namespace morsel::bench
