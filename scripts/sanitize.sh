#!/usr/bin/env bash
# Runs the tests under sanitizers, any finding of which fails the test; a build folder each.
#   scripts/sanitize.sh [asan-ubsan|tsan]…    both if none is named; tsan has the library's tests alone
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-dependencies.sh --test
presets=("$@")
[[ $# -gt 0 ]] || presets=(asan-ubsan tsan)
for preset in "${presets[@]}"; do
  cmake --preset "$preset"
  cmake --build --preset "$preset"
  ctest --preset "$preset"
done
