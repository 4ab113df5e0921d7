#!/usr/bin/env bash
# Makes the Debian packages and installs them with dpkg into an empty folder that holds, apart from them,
# only the packages that they say they need, taken from this machine; then uses them in there. The same in
# a whole Debian, over the network: scripts/clean-root.sh.
#   check_deb.sh BUILD CPACK
set -euo pipefail

build=$1 cpack=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$work/root

"$cpack" --config "$build/CPackConfig.cmake" -B "$work" >"$work/log" || { cat "$work/log" && exit 1; }
packages=("$work"/*.deb)

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
for package in "${packages[@]}"; do
  mapfile -t -O "${#waiting[@]}" waiting < <(dpkg-deb --field "$package" Depends | names)
done
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

mkdir -p "$root"/tmp "$root"/usr/{bin,lib,lib64,sbin} "$root"/var/lib/dpkg/{info,updates} "$root/var/lib/dpkg/triggers"
for folder in bin lib lib64 sbin; do ln -s "usr/$folder" "$root/$folder"; done
dpkg-query --listfiles "${needed[@]}" | grep -v '^$\|/\.$' | sort -u |
  tar -C / -c --no-recursion --ignore-failed-read -T - 2>/dev/null |
  tar -C "$root" -x --keep-directory-symlink
# Where several packages have a library, its name is none of theirs.
find /etc/alternatives /usr/lib \( -path '/etc/*' -o -lname '/etc/alternatives/*' \) -name '*.so.*' |
  tar -C / -c -T - 2>/dev/null | tar -C "$root" -x --keep-directory-symlink
dpkg-query --status "${needed[@]}" >"$root/var/lib/dpkg/status"
for name in "${needed[@]}"; do
  cp /var/lib/dpkg/info/"$name"{,:*}.list "$root/var/lib/dpkg/info/" 2>/dev/null || true
done

# dpkg and chroot want to be root: of a namespace of its own where this is not.
as_root=()
[[ $EUID -eq 0 ]] || as_root=(unshare --user --map-root-user)
"${as_root[@]}" dpkg --root="$root" --force-not-root --install "${packages[@]}" >"$work/log" 2>&1 ||
  { cat "$work/log" && exit 1; }

"$(dirname "$0")/in_root.sh" "$root"
echo "installed $(basename -a "${packages[@]}" | xargs) beside: ${needed[*]}"
