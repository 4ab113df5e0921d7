#include "base/threads.hpp"

#include <gtest/gtest.h>

#include <cstddef>
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

}  // namespace
}  // namespace morsel
