#include "serve/watched_work.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <morsel/error.hpp>
#include <stdexcept>
#include <string>
#include <thread>

namespace morsel::serve {
namespace {

constexpr std::chrono::minutes kPatience{1};

void finish(WatchedWork& work) {
  while (work.wait(kPatience)) continue;
}

TEST(WatchedWork, TellsWhatIsDoneAndThenTheResult) {
  std::promise<void> heard;
  WatchedWork work([&](const Progress& progress) {
    progress.report("compare", 0.5);
    progress.report("compare", 0.25);  // of another thread, late
    heard.get_future().wait();
    return std::string("answer");
  });
  std::optional<int> done = work.wait(kPatience);
  while (done && *done < 50) done = work.wait(kPatience);
  EXPECT_EQ(done, 50);
  EXPECT_EQ(work.wait(std::chrono::milliseconds(1)), 50);
  heard.set_value();
  finish(work);
  EXPECT_EQ(work.take(), "answer");
}

TEST(WatchedWork, TakeThrowsWhatTheWorkThrew) {
  WatchedWork work([](const Progress&) -> std::string { throw std::runtime_error("no"); });
  finish(work);
  EXPECT_THROW((void)work.take(), std::runtime_error);
}

TEST(WatchedWork, IsCancelledWhenNobodyListens) {
  std::atomic<bool> cancelled{false};
  {
    const WatchedWork work([&](const Progress& progress) -> std::string {
      try {
        while (true) {
          progress.check();
          std::this_thread::yield();
        }
      } catch (const Error& error) {
        cancelled = error.code() == ErrorCode::kCancelled;
        throw;
      }
    });
  }
  EXPECT_TRUE(cancelled);
}

}  // namespace
}  // namespace morsel::serve
