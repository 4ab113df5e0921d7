#!/usr/bin/env bash
# Formats all C++ files in place, and the viewer where its packages are installed; --check only
# says which C++ files are not formatted (the test viewer_check looks at the viewer).
set -euo pipefail
cd "$(dirname "$0")/.."

mode=(-i)
[[ ${1:-} == --check ]] && mode=(--dry-run -Werror)
folders=()
for folder in include src apps fuzz tests python; do
  [[ -d $folder ]] && folders+=("$folder")
done
find "${folders[@]}" -type f \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
  xargs -0 -r clang-format "${mode[@]}"
if [[ ${1:-} != --check && -d web/node_modules ]]; then npm --prefix web run --silent format; fi
