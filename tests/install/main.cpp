// The smallest program that uses an installed morsel.
#include <iostream>
#include <morsel/error.hpp>
#include <morsel/progress.hpp>

int main() {
  morsel::Progress progress;
  progress.cancel();
  try {
    progress.check();
  } catch (const morsel::Error& error) {
    std::cout << "consumer: " << error.what() << '\n';
    return error.code() == morsel::ErrorCode::kCancelled ? 0 : 1;
  }
  return 1;
}
