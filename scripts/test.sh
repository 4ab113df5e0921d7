#!/usr/bin/env bash
# What every change must pass, each step with its seconds: a release build with warnings as errors,
# all tests (the layer check and a consumer of the installed library among them), and the quick lint
# checks. The slow checks, sanitizers and clang-tidy, are `make sanitize` and `make lint`.
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

step "install what is missing" scripts/install-dependencies.sh --test
step "configure" cmake --preset release
step "build" cmake --build --preset release
step "test" ctest --preset release
step "lint" scripts/lint.sh --quick
step "documentation" scripts/docs.sh
echo "All passed in $((SECONDS / 60)) min $((SECONDS % 60)) s."
