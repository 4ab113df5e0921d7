#!/usr/bin/env bash
# Layout, layers, shell scripts and, unless --quick is given, clang-tidy; all findings are errors.
# Reads the compile commands of the release build, which need not be compiled.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-dependencies.sh --lint

echo "clang-format"
scripts/format.sh --check

echo "layers"
python3 tests/check_layers.py

echo "shellcheck"
find scripts .ci tests python -type f \( -name '*.sh' -o -path '.ci/run' \) -print0 | xargs -0 shellcheck

[[ ${1-} == --quick ]] && exit 0

echo "clang-tidy"
cmake --preset release >/dev/null
scripts/tidy.py build/release
