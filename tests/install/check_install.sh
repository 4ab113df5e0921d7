#!/usr/bin/env bash
# Installs BUILD into a temporary prefix, moves the prefix, then builds and runs a consumer against
# it with every third-party package out of reach, and runs the installed program.
#   check_install.sh BUILD CMAKE CXX
set -euo pipefail

build=$1 cmake=$2 compiler=$3
source=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --prefix "$work/staged" >/dev/null
mv "$work/staged" "$work/moved"

hidden=()
if compgen -G "$work/moved/lib*/libmorsel.so*" >/dev/null ||
  compgen -G "$work/moved/lib/*/libmorsel.so*" >/dev/null; then
  for package in CGAL TBB Eigen3 nanoflann ZLIB PNG fmt nlohmann_json CLI11; do
    hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
  done
fi
"$cmake" -S "$source" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/moved" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release "${hidden[@]}" >/dev/null
"$cmake" --build "$work/build"
"$work/build/consumer"

if [[ -e $work/moved/bin/morsel ]]; then
  "$work/moved/bin/morsel" --version
else
  echo "no program in this build"
fi
