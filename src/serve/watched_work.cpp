#include "serve/watched_work.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace morsel::serve {

WatchedWork::WatchedWork(Work work)
    : progress_([this](std::string_view, double fraction) { report(fraction); }),
      thread_([this, work = std::move(work)] {
        std::string result;
        std::exception_ptr failure;
        try {
          result = work(progress_);
        } catch (...) {
          failure = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        result_ = std::move(result);
        failure_ = failure;
        ended_ = true;
        changed_.notify_all();
      }) {}

WatchedWork::~WatchedWork() { progress_.cancel(); }

// Threads that share the work may report in any order.
void WatchedWork::report(double fraction) {
  const std::lock_guard lock(mutex_);
  const int hundredths = static_cast<int>(100.0 * std::clamp(fraction, 0.0, 1.0));
  if (hundredths <= hundredths_) return;
  hundredths_ = hundredths;
  changed_.notify_all();
}

std::optional<int> WatchedWork::wait(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, most, [&] { return ended_ || hundredths_ > told_; });
  if (ended_) return std::nullopt;
  told_ = hundredths_;
  return hundredths_;
}

std::string WatchedWork::take() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  return std::move(result_);
}

}  // namespace morsel::serve
