// libFuzzer's entry: morsel_fuzz --target=NAME [libFuzzer's options] [folders]. libFuzzer leaves
// options that begin with "--" to the program.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "targets.hpp"

namespace {

const morsel::fuzz::Target* chosen = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view kOption = "--target=";
  for (int i = 1; i < *argc; ++i) {
    const std::string_view argument = (*argv)[i];
    if (argument.starts_with(kOption)) {
      chosen = morsel::fuzz::find_target(argument.substr(kOption.size()));
    }
  }
  if (chosen != nullptr) return 0;
  std::fprintf(stderr, "expected --target= and one of:");
  for (const auto& target : morsel::fuzz::targets()) {
    std::fprintf(stderr, " %.*s", static_cast<int>(target.name.size()), target.name.data());
  }
  std::fprintf(stderr, "\n");
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen->run(chosen->name, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
