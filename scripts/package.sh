#!/usr/bin/env bash
# Builds the Debian packages: morsel, the program, its viewer, the library and its headers, and
# python3-morsel. Times in them are those of the last commit, or SOURCE_DATE_EPOCH, so that the same sources
# give the same bytes.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-dependencies.sh --python
cmake --preset release
cmake --build --preset release --target morsel morsel_cli morsel_python
if [[ -z ${SOURCE_DATE_EPOCH-} ]]; then
  SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
  export SOURCE_DATE_EPOCH
fi
cpack --config build/release/CPackConfig.cmake -B build/package
ls -l build/package/*.deb
