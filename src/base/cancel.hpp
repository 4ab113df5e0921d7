// Lets long work answer soon when it is asked to stop, without every function of a stage being
// handed who may ask.
#pragma once

#include <algorithm>
#include <cstddef>
#include <morsel/progress.hpp>

namespace morsel {

/// While it lives, check_cancelled() on this thread, and the loops of base/threads.hpp that are
/// begun on it, throw Error(kCancelled) once `progress` was asked to stop; null changes nothing.
class CancelScope {
 public:
  explicit CancelScope(const Progress* progress) : before_(innermost) {
    if (progress != nullptr) innermost = progress;
  }
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;
  ~CancelScope() { innermost = before_; }

  [[nodiscard]] static const Progress* current() { return innermost; }

 private:
  static thread_local const Progress* innermost;
  const Progress* before_;
};

/// Cheap, but not for each turn of the smallest loops.
inline void check_cancelled() {
  if (CancelScope::current() != nullptr) CancelScope::current()->check();
}

/// Calls body(begin, end) over consecutive pieces of [begin, end), none of which takes long.
template <typename Body>
void in_pieces(std::size_t begin, std::size_t end, const Body& body) {
  constexpr std::size_t kPiece = 16384;
  for (; begin < end; begin += kPiece) {
    check_cancelled();
    body(begin, std::min(begin + kPiece, end));
  }
}

/// Calls body(i) for each i in [0, count), one after the other.
template <typename Body>
void in_turn(std::size_t count, const Body& body) {
  in_pieces(0, count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

}  // namespace morsel
