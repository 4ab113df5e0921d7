#include "base/threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <morsel/error.hpp>
#include <vector>

#include "base/random.hpp"

namespace morsel {
namespace {

TEST(ThreadsTest, CollectedValuesComeInTheOrderOfTheRange) {
  const auto odd = [](std::size_t begin, std::size_t end, std::vector<std::size_t>& values) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i % 2 == 1) values.push_back(i);
    }
  };
  for (const int threads : {1, 2, 7}) {
    const auto values = parallel_collect<std::size_t>(100001, threads, odd);
    ASSERT_EQ(values.size(), 50000U);
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], 2 * i + 1);
    EXPECT_TRUE(parallel_collect<std::size_t>(0, threads, odd).empty());
  }
}

TEST(ThreadsTest, SortsTheSameWithAnyNumberOfThreads) {
  Random random(3);
  std::vector<double> values(50000);
  for (double& value : values) value = random.uniform();
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (const int threads : {1, 2, 5}) {
    std::vector<double> copy = values;
    parallel_sort(copy, threads);
    EXPECT_EQ(copy, sorted);
  }
}

TEST(ThreadsTest, BackgroundTasksAreDoneAfterTheWait) {
  for (const int threads : {1, 2, 5}) {
    std::vector<int> done(1000, 0);
    BackgroundTasks tasks(threads);
    for (int& one : done) tasks.run([&one] { one = 1; });
    tasks.wait();
    EXPECT_EQ(std::ranges::count(done, 1), 1000);
  }
}

// What each kind of loop has done once it is asked to stop by its own hundredth value.
template <typename Loop>
void expect_stops(const Loop& loop) {
  for (const int threads : {1, 2, 5}) {
    Progress progress;
    const CancelScope scope(&progress);
    std::atomic<std::size_t> done{0};
    const auto count = [&] {
      if (++done == 100) progress.cancel();
    };
    try {
      loop(threads, count);
      FAIL() << "went on to the end";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCancelled);
    }
    EXPECT_LT(done, 200000U) << "of a million";
  }
}

constexpr std::size_t kMillion = 1000000;

TEST(ThreadsTest, LoopsStopWhenTheyAreAskedTo) {
  const auto each = [](const auto& count) {
    return [&count](std::size_t begin, std::size_t end) {
      for (; begin < end; ++begin) count();
    };
  };
  expect_stops(
      [&](int threads, const auto& count) { parallel_ranges(kMillion, threads, each(count)); });
  expect_stops([&](int threads, const auto& count) {
    parallel_rows(kMillion, threads, [&](std::size_t /*row*/) { count(); });
  });
  expect_stops([&](int threads, const auto& count) {
    (void)parallel_collect<int>(kMillion, threads,
                                [&](std::size_t begin, std::size_t end, std::vector<int>& /*all*/) {
                                  each(count)(begin, end);
                                });
  });
  expect_stops([&](int /*threads*/, const auto& count) {
    in_turn(kMillion, [&](std::size_t /*i*/) { count(); });
  });
}

TEST(ThreadsTest, SortingStopsWhenItIsAskedTo) {
  static std::atomic<std::size_t> comparisons;
  static Progress* asked;
  struct Value {
    double value = 0.0;
    bool operator<(const Value& other) const {
      if (++comparisons == 100) asked->cancel();
      return value < other.value;
    }
  };
  Random random(4);
  std::vector<Value> values(kMillion);
  for (Value& one : values) one.value = random.uniform();
  for (const int threads : {1, 2}) {
    Progress progress;
    asked = &progress;
    comparisons = 0;
    const CancelScope scope(&progress);
    EXPECT_THROW(parallel_sort(values, threads), Error);
    EXPECT_LT(comparisons, 1000U) << "of some twenty million";
  }
}

TEST(ThreadsTest, WhatATaskDoesStopsWithItsGiver) {
  Progress progress;
  const CancelScope scope(&progress);
  progress.cancel();
  for (const int threads : {1, 2}) {
    std::atomic<int> stopped{0};
    BackgroundTasks tasks(threads);
    for (int i = 0; i < 100; ++i) {
      tasks.run([&stopped] {
        try {
          check_cancelled();
        } catch (const Error&) {
          ++stopped;
        }
      });
    }
    tasks.wait();
    EXPECT_EQ(stopped, 100);
  }
}

// For the thread sanitizer, which must be told of tasks that end by an exception too.
TEST(ThreadsTest, WhatWasWrittenBeforeTheStopIsTheGivers) {
  constexpr std::size_t kRows = 20000;
  for (const int threads : {1, 2, 5}) {
    Progress progress;
    const CancelScope scope(&progress);
    std::vector<int> written(kRows, 0);
    EXPECT_THROW(parallel_rows(kRows, threads,
                               [&](std::size_t i) {
                                 written[i] = 1;
                                 if (i == kRows / 4 * 3) progress.cancel();
                                 check_cancelled();
                               }),
                 Error);
    EXPECT_GT(std::ranges::count(written, 1), 0);
    EXPECT_LT(std::ranges::count(written, 1), static_cast<std::ptrdiff_t>(kRows));
  }
}

TEST(ThreadsTest, NothingStopsOutsideOfItsScope) {
  Progress progress;
  progress.cancel();
  {
    const CancelScope scope(&progress);
    const CancelScope same(nullptr);
    EXPECT_THROW(check_cancelled(), Error);
  }
  EXPECT_NO_THROW(check_cancelled());
}

}  // namespace
}  // namespace morsel
