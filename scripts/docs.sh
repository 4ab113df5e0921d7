#!/usr/bin/env bash
# Builds the documentation: a site of docs/, and in it the API reference of the public headers. A type
# or function without a comment, a wrong comment and a broken link are errors; a data member may speak
# for itself.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-dependencies.sh --docs
mkdir -p build/docs
mkdocs build --quiet --strict --clean --site-dir build/docs/site
doxygen docs/Doxyfile
# Move constructors and the like say all by their types.
if grep -vE '\(variable\)|&&\) noexcept' build/docs/warnings.log; then exit 1; fi
echo "Look at build/docs/site/index.html"
