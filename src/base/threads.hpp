// Runs a stage with a given number of threads. All threads of the stages are started here, and stop
// early when the caller's CancelScope says so.
#pragma once

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif
#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/cancel.hpp"

namespace morsel {

/// 0 becomes the number of cores that this process may use.
inline int resolve_threads(int threads) {
  return threads > 0 ? threads : tbb::info::default_concurrency();
}

/// Tells the thread sanitizer what it cannot see, as Debian's oneTBB is not built with it: that a
/// task is copied before it runs, and that all tasks come before what the giver of them does after
/// its wait. It is told nothing that would order two tasks. Does nothing in other builds.
#ifdef __SANITIZE_THREAD__
inline char tasks_done;
struct GiverScope {
  GiverScope() {}
  ~GiverScope() { __tsan_acquire(&tasks_done); }
};
template <typename Task>
class Handed {
 public:
  // Where a task was, another one may be made.
  explicit Handed(Task task) : task_((arrived(), std::move(task))) { __tsan_release(this); }
  Handed(const Handed& other) : task_((arrived(), other.arrived().task_)) { __tsan_release(this); }
  Handed& operator=(const Handed&) = delete;
  ~Handed() { __tsan_release(this); }

  template <typename... Arguments>
  void operator()(Arguments&&... arguments) const {
    const DoneScope done;
    arrived().task_(std::forward<Arguments>(arguments)...);
  }

 private:
  // Tells it of a task that ends by an exception too.
  struct DoneScope {
    DoneScope() {}
    ~DoneScope() { __tsan_release(&tasks_done); }
  };
  const Handed& arrived() const {
    __tsan_acquire(const_cast<Handed*>(this));
    return *this;
  }

  Task task_;
};
#else
struct [[maybe_unused]] GiverScope {};
template <typename Task>
using Handed = Task;
#endif

/// The task as another thread may run it: it can be cancelled as its giver can.
template <typename Task>
[[nodiscard]] auto handed(Task task) {
  const auto scoped = [task = std::move(task),
                       whose = CancelScope::current()](auto&&... arguments) {
    const CancelScope scope(whose);
    task(std::forward<decltype(arguments)>(arguments)...);
  };
  return Handed<std::remove_const_t<decltype(scoped)>>(scoped);
}

/// Calls body(begin, end) over disjoint ranges that cover [0, count), on at most `threads` threads.
/// The caller keeps results independent of how the range is split.
template <typename Body>
void parallel_ranges(std::size_t count, int threads, const Body& body) {
  constexpr std::size_t kGrain = 2048;
  threads = resolve_threads(threads);
  if (threads == 1 || count <= kGrain) {
    in_pieces(0, count, body);
    return;
  }
  const tbb::blocked_range<std::size_t> all(0, count, kGrain);
  const auto task = handed([&body](const tbb::blocked_range<std::size_t>& range) {
    in_pieces(range.begin(), range.end(), body);
  });
  const GiverScope giver;
  tbb::task_arena arena(threads);
  arena.execute([&] { tbb::parallel_for(all, task); });
}

/// Calls body(i) for each i in [0, count), for rows that are costly and unequal.
template <typename Body>
void parallel_rows(std::size_t count, int threads, const Body& body) {
  threads = resolve_threads(threads);
  const auto turn = [&body](std::size_t i) {
    check_cancelled();
    body(i);
  };
  if (threads == 1) {
    for (std::size_t i = 0; i < count; ++i) turn(i);
    return;
  }
  const auto task = handed(turn);
  const GiverScope giver;
  tbb::task_arena arena(threads);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, task); });
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

/// Sorts by `before`, which must tell any two different values apart, for one result in every run.
/// Values hold no memory of their own: they are left in any order when the sorting is cancelled.
/// A piece for each thread is sorted, then neighbouring ones are merged.
template <typename Value, typename Before = std::less<Value>>
void parallel_sort(std::span<Value> values, int threads, const Before& before = {}) {
  constexpr std::size_t kWorthwhile = 4096;
  threads = values.size() < kWorthwhile ? 1 : resolve_threads(threads);
  const auto less = [whose = CancelScope::current(), &before](const Value& a, const Value& b) {
    if (whose != nullptr) whose->check();
    return before(a, b);
  };
  const std::size_t pieces = std::bit_ceil(static_cast<std::size_t>(threads));
  const auto at = [&](std::size_t piece) {
    return values.begin() + static_cast<std::ptrdiff_t>(piece * values.size() / pieces);
  };
  parallel_rows(pieces, threads, [&](std::size_t i) { std::sort(at(i), at(i + 1), less); });
  for (std::size_t width = 1; width < pieces; width *= 2) {
    parallel_rows(pieces / (2 * width), threads, [&](std::size_t i) {
      const std::size_t first = 2 * i * width;
      std::inplace_merge(at(first), at(first + width), at(first + 2 * width), less);
    });
  }
}
template <typename Value>
void parallel_sort(std::vector<Value>& values, int threads) {
  parallel_sort(std::span(values), threads);
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
    arena_.execute([&] { group_.run(handed(std::move(task))); });
  }
  void wait() {
    const GiverScope giver;
    arena_.execute([&] { group_.wait(); });
  }

 private:
  tbb::task_arena arena_;
  tbb::task_group group_;
};

}  // namespace morsel
