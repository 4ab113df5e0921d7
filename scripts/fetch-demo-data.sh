#!/usr/bin/env bash
# Takes the example data out of Debian's libcgal-demo package, without installing it or what it
# depends on, and puts it into DIR (default build/demo-data), complete or not at all. Of use here:
#   meshes/bull.off          6,200 vertices, 12,396 triangles
#   meshes/triceratops.off   2,832 vertices,  5,660 triangles
#   meshes/pig.off             468 vertices,    891 triangles; open: its legs end in holes
#   points_3/kitten.xyz      5,210 points with normals
#   points_3/hippo1.ply      6,104 points with normals, binary; scanned from one side, so open
set -euo pipefail

target=${1:-build/demo-data}
wanted=(meshes/bull.off meshes/triceratops.off meshes/pig.off points_3/kitten.xyz points_3/hippo1.ply)

complete() {
  local file
  for file in "${wanted[@]}"; do [[ -s $1/$file ]] || return 1; done
}
complete "$target" && exit 0

if ! command -v apt-get >/dev/null; then
  echo "$0: needs apt-get to download Debian's libcgal-demo" >&2
  exit 1
fi
mkdir -p "$(dirname "$target")"
work=$(mktemp -d "$target.XXXXXX")
trap 'rm -rf "$work"' EXIT

download() { (cd "$work" && apt-get -o APT::Sandbox::User= --quiet download libcgal-demo); }
update() {
  if [[ $EUID -eq 0 ]]; then apt-get --quiet update; else sudo apt-get --quiet update; fi
}

echo "Fetching example data from Debian's libcgal-demo into $target"
download || { update && download; }
dpkg -x "$work"/libcgal-demo_*.deb "$work/package"
archive=$(find "$work/package" -name 'data.tar.*' -print -quit)
mkdir "$work/unpacked"
tar -xf "$archive" -C "$work/unpacked" --strip-components=1
complete "$work/unpacked" || {
  echo "$0: this libcgal-demo lacks one of: ${wanted[*]}" >&2
  exit 1
}
rm -rf "$target"
mv "$work/unpacked" "$target"
chmod 755 "$target"
