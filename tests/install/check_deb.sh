#!/usr/bin/env bash
# Makes the Debian package and installs it with dpkg into an empty folder that holds, apart from it, only
# the packages that it says it needs, taken from this machine; then runs the program in there.
#   check_deb.sh BUILD CPACK
set -euo pipefail

build=$1 cpack=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$work/root

"$cpack" --config "$build/CPackConfig.cmake" -B "$work" >"$work/log" || { cat "$work/log" && exit 1; }
package=$(echo "$work"/morsel_*.deb)

# The first alternative that is installed of each item of "a (>= 1), b | c".
names() {
  local alternatives name
  sed 's/([^)]*)//g; s/:any//g; s/|/ /g' | tr ',' '\n' | while read -r -a alternatives; do
    for name in "${alternatives[@]}"; do
      if dpkg-query -W "$name" >/dev/null 2>&1; then echo "$name" && break; fi
    done
  done
}

needed=() waiting=()
mapfile -t waiting < <(dpkg-deb --field "$package" Depends | names)
waiting+=(dash libc-bin) # every Debian system has a shell, and ldconfig, which installing calls
while [[ ${#waiting[@]} -gt 0 ]]; do
  name=${waiting[0]}
  waiting=("${waiting[@]:1}")
  [[ " ${needed[*]} " == *" $name "* ]] && continue
  needed+=("$name")
  mapfile -t -O "${#waiting[@]}" waiting < <(
    dpkg-query -W -f='${Pre-Depends}, ${Depends}\n' "$name" | names
  )
done

mkdir -p "$root"/usr/{bin,lib,lib64,sbin} "$root"/var/lib/dpkg/{info,updates} "$root/var/lib/dpkg/triggers"
for folder in bin lib lib64 sbin; do ln -s "usr/$folder" "$root/$folder"; done
dpkg-query --listfiles "${needed[@]}" | grep -v '^$\|/\.$' | sort -u |
  tar -C / -c --no-recursion --ignore-failed-read -T - 2>/dev/null |
  tar -C "$root" -x --keep-directory-symlink
dpkg-query --status "${needed[@]}" >"$root/var/lib/dpkg/status"
for name in "${needed[@]}"; do
  cp /var/lib/dpkg/info/"$name"{,:*}.list "$root/var/lib/dpkg/info/" 2>/dev/null || true
done

# dpkg and chroot want to be root: of a namespace of its own where this is not.
as_root=()
[[ $EUID -eq 0 ]] || as_root=(unshare --user --map-root-user)
"${as_root[@]}" dpkg --root="$root" --force-not-root --install "$package" >"$work/log" 2>&1 ||
  { cat "$work/log" && exit 1; }

for file in usr/share/man/man1/morsel.1 usr/share/doc/morsel/{copyright,README.md} \
  usr/share/bash-completion/completions/morsel usr/share/zsh/site-functions/_morsel \
  usr/share/fish/vendor_completions.d/morsel.fish usr/include/morsel/morsel.hpp; do
  [[ -s $root/$file ]] || { echo "the package lacks $file" && exit 1; }
done

# Points of a ball, evenly spread.
awk 'BEGIN { for (i = 0; i < 2000; ++i) { z = 1 - (2 * i + 1) / 2000; r = sqrt(1 - z * z);
  a = 2.399963 * i; print r * cos(a), r * sin(a), z } }' >"$root/ball.xyz"
run() { "${as_root[@]}" chroot "$root" /usr/bin/morsel "$@"; }
run --version
run segment /ball.xyz --html /parts.html | tail -1
grep -q '<script' "$root/parts.html" || { echo "the package has no viewer" && exit 1; }
run index --database /shapes.db /ball.xyz | tail -1
run search --database /shapes.db /ball.xyz --top 1 | grep -q ball
echo "installed $(basename "$package") beside: ${needed[*]}"
