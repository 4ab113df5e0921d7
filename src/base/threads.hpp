// Runs a stage with a given number of threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace morsel {

/// 0 becomes the number of cores that this process may use.
inline int resolve_threads(int threads) {
  return threads > 0 ? threads : tbb::info::default_concurrency();
}

/// Calls body(begin, end) over disjoint ranges that cover [0, count), on at most `threads` threads.
/// The caller keeps results independent of how the range is split.
template <typename Body>
void parallel_ranges(std::size_t count, int threads, const Body& body) {
  constexpr std::size_t kGrain = 2048;
  threads = resolve_threads(threads);
  if (threads == 1 || count <= kGrain) {
    if (count > 0) body(std::size_t{0}, count);
    return;
  }
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, kGrain),
        [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
  });
}

/// Calls body(i) for each i in [0, count), for rows that are costly and unequal.
template <typename Body>
void parallel_rows(std::size_t count, int threads, const Body& body) {
  threads = resolve_threads(threads);
  if (threads == 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  tbb::task_arena arena(threads);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, body); });
}

/// What collect(begin, end, values) appends for disjoint ranges that cover [0, count), in the order
/// of the ranges.
template <typename Value, typename Collect>
std::vector<Value> parallel_collect(std::size_t count, int threads, const Collect& collect) {
  constexpr std::size_t kChunk = 16384;
  std::vector<std::vector<Value>> chunks((count + kChunk - 1) / kChunk);
  parallel_rows(chunks.size(), threads, [&](std::size_t i) {
    collect(i * kChunk, std::min((i + 1) * kChunk, count), chunks[i]);
  });
  std::vector<Value> values;
  std::size_t total = 0;
  for (const auto& chunk : chunks) total += chunk.size();
  values.reserve(total);
  for (const auto& chunk : chunks) values.insert(values.end(), chunk.begin(), chunk.end());
  return values;
}

/// Sorts by operator<, which must tell any two different values apart, for one result in every run.
template <typename Value>
void parallel_sort(std::vector<Value>& values, int threads) {
  threads = resolve_threads(threads);
  if (threads == 1) {
    std::sort(values.begin(), values.end());
    return;
  }
  tbb::task_arena arena(threads);
  arena.execute([&] { tbb::parallel_sort(values.begin(), values.end()); });
}

/// Work for at most `threads` − 1 threads beside the caller's, who may go on meanwhile and does
/// what is left of it in wait().
class BackgroundTasks {
 public:
  explicit BackgroundTasks(int threads) : arena_(resolve_threads(threads)) {}
  BackgroundTasks(const BackgroundTasks&) = delete;
  BackgroundTasks& operator=(const BackgroundTasks&) = delete;
  ~BackgroundTasks() { wait(); }

  template <typename Task>
  void run(Task task) {
    arena_.execute([&] { group_.run(std::move(task)); });
  }
  void wait() {
    arena_.execute([&] { group_.wait(); });
  }

 private:
  tbb::task_arena arena_;
  tbb::task_group group_;
};

}  // namespace morsel
