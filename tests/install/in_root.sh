#!/usr/bin/env bash
# Uses the packages that are installed in ROOT, from in there: every file that a user expects, the
# program on a file, and where the Python package is a Python program.
#   in_root.sh ROOT
set -euo pipefail

root=$1
source=$(cd "$(dirname "$0")" && pwd)

# Where this is not root: of a namespace of its own.
as_root=()
[[ $EUID -eq 0 ]] || as_root=(unshare --user --map-root-user)
inside() { "${as_root[@]}" chroot "$root" "$@"; }

for file in share/man/man1/morsel.1 share/doc/morsel/{copyright,README.md} include/morsel/morsel.hpp \
  share/bash-completion/completions/morsel share/zsh/site-functions/_morsel \
  share/fish/vendor_completions.d/morsel.fish; do
  [[ -s $root/usr/$file ]] || { echo "the package lacks usr/$file" && exit 1; }
done

# Points of a ball, evenly spread.
awk 'BEGIN { for (i = 0; i < 2000; ++i) { z = 1 - (2 * i + 1) / 2000; r = sqrt(1 - z * z);
  a = 2.399963 * i; print r * cos(a), r * sin(a), z } }' >"$root/tmp/ball.xyz"
inside morsel --version
inside morsel segment /tmp/ball.xyz --html /tmp/parts.html | tail -1
grep -q '<script' "$root/tmp/parts.html" || { echo "the package has no viewer" && exit 1; }
inside morsel index --database /tmp/shapes.db /tmp/ball.xyz | tail -1
inside morsel search --database /tmp/shapes.db /tmp/ball.xyz --top 1 | grep -q ball

if [[ -e $root/usr/lib/python3/dist-packages/morsel ]]; then
  cp "$source/consumer.py" "$root/tmp"
  inside python3 -B /tmp/consumer.py /usr/lib/python3/dist-packages
fi
