// Work on a thread of its own, of which another thread hears how far it is.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <morsel/progress.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace morsel::serve {

class WatchedWork {
 public:
  using Work = std::function<std::string(const Progress& progress)>;

  /// Begins at once.
  explicit WatchedWork(Work work);
  WatchedWork(const WatchedWork&) = delete;
  WatchedWork& operator=(const WatchedWork&) = delete;
  /// Cancels the work and waits for its end.
  ~WatchedWork();

  /// The hundredths that are done, once they have grown or `most` has passed; nothing at the end.
  [[nodiscard]] std::optional<int> wait(std::chrono::milliseconds most);
  /// After the end, once: what the work returned. Throws what it threw.
  [[nodiscard]] std::string take();

 private:
  void report(double fraction);

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  int hundredths_ = 0;
  int told_ = -1;  // by wait()
  bool ended_ = false;
  std::string result_;
  std::exception_ptr failure_;
  Progress progress_;
  std::jthread thread_;  // the last: it uses the others
};

}  // namespace morsel::serve
