#!/usr/bin/env bash
# Builds the API reference of the public headers. A type or function without a comment, or a wrong
# comment, is an error; a data member may speak for itself.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-dependencies.sh --dev
mkdir -p build/docs
doxygen docs/Doxyfile
if grep -v '(variable)' build/docs/warnings.log; then exit 1; fi
echo "Look at build/docs/html/index.html"
