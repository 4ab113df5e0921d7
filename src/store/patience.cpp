#include "store/patience.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace morsel::store {

void Patience::wait(const LostConnection& lost) {
  const auto now = std::chrono::steady_clock::now();
  if (!began_) began_ = now;
  if (now - *began_ > kPatience) {
    throw Error(ErrorCode::kOutput,
                fmt::format("{}; tried again for {} s", lost.what(), kPatience.count()));
  }
  std::this_thread::sleep_for(pause_);
  pause_ = std::min(2 * pause_, std::chrono::milliseconds(2000));
}

}  // namespace morsel::store
