// morsel: progress and cancellation of long work.
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

namespace morsel {

/// Passed by reference into long work. The work reports through `report`; any thread may `cancel`.
class Progress {
 public:
  /// `stage` is a stage's name as in the report ("triangulate"); `fraction` in [0, 1] of all work.
  using Callback = std::function<void(std::string_view stage, double fraction)>;

  Progress() = default;
  /// Reports to `callback`, on whatever thread the work runs.
  explicit Progress(Callback callback) : callback_(std::move(callback)) {}
  /// For one piece of the work that `whole` is about: reports nothing, is cancelled with it.
  explicit Progress(const Progress* whole) : whole_(whole) {}

  /// Asks the work to stop: it then throws Error(kCancelled). Safe from any thread and from a
  /// signal handler.
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  /// Whether it was asked to stop.
  [[nodiscard]] bool cancelled() const noexcept {
    return cancelled_.load(std::memory_order_relaxed) || (whole_ != nullptr && whole_->cancelled());
  }

  /// Calls the callback, then throws Error(kCancelled) if cancellation was asked for.
  void report(std::string_view stage, double fraction) const;
  /// Throws Error(kCancelled) if cancellation was asked for; cheap enough for inner loops.
  void check() const {
    if (cancelled()) throw_cancelled();
  }

 private:
  [[noreturn]] static void throw_cancelled();

  Callback callback_;
  const Progress* whole_ = nullptr;
  std::atomic<bool> cancelled_{false};
};

}  // namespace morsel
