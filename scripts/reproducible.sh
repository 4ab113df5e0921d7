#!/usr/bin/env bash
# Builds the Debian packages of HEAD twice, from two folders whose names differ in length, without a
# compiler cache, at different times and in different languages, and compares the bytes.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install-dependencies.sh
commit=$(git rev-parse HEAD)
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH CCACHE_DISABLE=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

build() {
  local folder=$work/$1
  git clone --quiet --no-checkout . "$folder"
  git -C "$folder" checkout --quiet --detach "$commit"
  (cd "$folder" && scripts/package.sh >"$work/log" 2>&1) || { tail -20 "$work/log" && exit 1; }
  mkdir "$work/packages-$1"
  cp "$folder"/build/package/*.deb "$work/packages-$1"
}
TZ=UTC LC_ALL=C build one
TZ=Asia/Tokyo LC_ALL=C.UTF-8 build another-one-of-a-longer-name
sha256sum "$work"/packages-*/*.deb
diff -r "$work"/packages-* && echo "The two builds have the same bytes."
