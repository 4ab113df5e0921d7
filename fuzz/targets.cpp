#include "targets.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

namespace morsel::fuzz {
namespace {

// The readers' names are the extensions of their files.
constexpr std::array kTargets{
    Target{"ply", run_reader},
    Target{"pcd", run_reader},
    Target{"xyz", run_reader},
    Target{"off", run_reader},
    Target{"obj", run_reader},
    Target{"npy", run_reader},
    Target{"las", run_reader},
    Target{"stl", run_reader},
    Target{"gltf", run_reader},
    Target{"signature", run_signature},
    Target{"signature_json", run_signature_json},
    Target{"sketch", run_sketch},
    Target{"block", run_block},
    Target{"lines", run_lines},
    Target{"database", run_database},
    Target{"http", run_http},
    Target{"segment", run_segment},
};

}  // namespace

std::span<const Target> targets() { return kTargets; }

const Target* find_target(std::string_view name) {
  const auto found = std::ranges::find(kTargets, name, &Target::name);
  return found == kTargets.end() ? nullptr : &*found;
}

void require(bool holds, std::string_view promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %.*s\n", static_cast<int>(promise.size()), promise.data());
  std::abort();
}

}  // namespace morsel::fuzz
