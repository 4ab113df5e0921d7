#include <morsel/error.hpp>
#include <morsel/progress.hpp>

#include "base/cancel.hpp"

namespace morsel {

thread_local const Progress* CancelScope::innermost = nullptr;

void Progress::throw_cancelled() { throw Error(ErrorCode::kCancelled, "cancelled"); }

void Progress::report(std::string_view stage, double fraction) const {
  if (callback_) callback_(stage, fraction);
  check();
}

}  // namespace morsel
