#!/usr/bin/env bash
# Makes a new Debian 12 with mmdebstrap, lets its apt install the Debian packages with what they depend on,
# uses them in there, builds the C++ consumer against them with the compiler of that Debian, and removes them
# again, after which nothing may be left. Needs the network; nothing of it stays on this machine.
#   scripts/clean-root.sh [MIRROR]
set -euo pipefail
cd "$(dirname "$0")/.."

# In the new Debian; called by mmdebstrap.
use_packages() {
  local root=$1 packages left
  mapfile -t packages < <(basename -a build/package/*.deb)
  inside() { DEBIAN_FRONTEND=noninteractive chroot "$root" "$@"; }
  apt() { inside apt-get -qq -y --no-install-recommends "$@" >/dev/null; }
  cp build/package/*.deb "$root/tmp"
  cp -r tests/install "$root/tmp/consumer"
  apt install "${packages[@]/#/\/tmp/}"
  tests/install/in_root.sh "$root"
  apt install cmake make g++
  inside sh -c 'cmake -S /tmp/consumer -B /tmp/built && cmake --build /tmp/built' >/dev/null
  inside /tmp/built/consumer
  apt purge morsel python3-morsel
  left=$(find "$root"/{etc,usr,var/lib} -path '*morsel*')
  [[ -z $left ]] || { echo "left behind:"$'\n'"$left" && exit 1; }
}

if [[ ${1-} == --use-packages ]]; then
  use_packages "$2"
  exit
fi
scripts/install-dependencies.sh --clean-root
rm -f build/package/*.deb
scripts/package.sh
# shellcheck disable=SC2016 # for mmdebstrap's shell
mmdebstrap --variant=apt --format=null --quiet \
  --customize-hook='scripts/clean-root.sh --use-packages "$1"' \
  bookworm /dev/null "deb ${1:-http://deb.debian.org/debian} bookworm main"
echo "The packages work in a new Debian 12, and nothing of them is left after removing them."
