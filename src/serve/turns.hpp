// Bounds how many do something at once.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>

namespace morsel::serve {

/// Whoever comes first goes first; at most `most` at once.
class Turns {
 public:
  explicit Turns(std::size_t most) : free_(most) {}

  template <class Work>
  auto take(const Work& work) {
    const Turn turn(*this);
    return work();
  }

 private:
  class Turn {
   public:
    explicit Turn(Turns& turns) : turns_(turns) {
      std::unique_lock lock(turns_.mutex_);
      const std::uint64_t mine = turns_.next_++;
      turns_.changed_.wait(lock, [&] { return mine == turns_.served_ && turns_.free_ > 0; });
      ++turns_.served_;
      --turns_.free_;
      turns_.changed_.notify_all();
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    ~Turn() {
      const std::lock_guard lock(turns_.mutex_);
      ++turns_.free_;
      turns_.changed_.notify_all();
    }

   private:
    Turns& turns_;
  };

  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t free_;
  std::uint64_t next_ = 0;
  std::uint64_t served_ = 0;
};

}  // namespace morsel::serve
