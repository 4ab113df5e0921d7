#!/usr/bin/env bash
# All that a change must pass, each step with its seconds: a release build with warnings as errors
# and all tests (the layer check and a consumer of the installed library among them), the tests
# again under address and undefined-behaviour sanitizers, and the lint checks.
set -euo pipefail
cd "$(dirname "$0")/.."

step() {
  local title=$1 began=$SECONDS
  shift
  echo "== $title"
  "$@"
  echo "== $title: $((SECONDS - began)) s"
  echo
}

step "install what is missing" scripts/install-dependencies.sh --lint
for preset in release asan-ubsan; do
  step "$preset: configure" cmake --preset "$preset"
  step "$preset: build" cmake --build --preset "$preset"
  step "$preset: test" ctest --preset "$preset"
done
step "lint" scripts/lint.sh
echo "All passed in $((SECONDS / 60)) min $((SECONDS % 60)) s."
