#!/usr/bin/env bash
# Measures everything that the paper shows and makes one page of it.
#   scripts/reproduce.sh                        example data of Debian, shapes of our own generator
#   ARGS="--psb DIR" scripts/reproduce.sh       benchmarks and scans of the user's (ARGS=--help)
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8

out=${OUT:-out/reproduction}
data=build/demo-data
read -r -a options <<<"${ARGS:-}"

scripts/install-dependencies.sh
if [[ ! -f build/release/build.ninja ]]; then cmake --preset release; fi
cmake --build --preset release --target morsel_reproduce
scripts/fetch-demo-data.sh "$data"
build/release/apps/morsel-reproduce/morsel-reproduce --data "$data" --out "$out" "${options[@]}"
[[ " ${options[*]} " == *" --help "* ]] || python3 apps/morsel-reproduce/page/page.py "$out"
