#!/usr/bin/env bash
# Segments real input and shows where the results are.
#   scripts/demo.sh                      two meshes, sampled with noise, and two scans as they come
#   INPUT=scan.ply scripts/demo.sh       a file of the user's; ARGS="--parts 5" adds options
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8

morsel=build/release/apps/morsel/morsel
out=${OUT:-out}

scripts/install-dependencies.sh
if [[ ! -f build/release/build.ninja ]]; then cmake --preset release; fi
cmake --build --preset release --target morsel_cli
mkdir -p "$out"

labels=$(mktemp)
trap 'rm -f "$labels"' EXIT
rows=()
status=0

# LABELS → points, parts and the largest parts' shares of the points, between tabs.
summarize() {
  sort "$1" | uniq -c | sort -rn | awk '
    { size[NR] = $1; total += $1 }
    END {
      shares = ""
      for (i = 1; i <= NR && i <= 8; ++i) shares = shares sprintf("%.0f%% ", 100 * size[i] / total)
      printf "%d\t%d\t%s", total, NR, shares (NR > 8 ? "…" : "")
    }'
}

# Segments FILE [OPTION…], writes out/NAME.html, .png, .json and out/NAME_parts.ply, and adds a row
# to the table.
segment() {
  local file=$1 name result=0 began=$EPOCHREALTIME page=()
  name=$(basename "$file")
  name=${name%.*}
  # A program built without Node.js writes no pages.
  if [[ -s build/release/src/html/viewer.html ]]; then page=(--html "$out/$name.html"); fi
  echo
  echo "\$ morsel segment $*"
  "$morsel" segment "$@" --picture "$out/$name.png" -o "$out/${name}_parts.ply" \
    --report "$out/$name.json" --labels "$labels" "${page[@]}" || result=$?
  if [[ $result -eq 0 ]]; then
    local seconds
    seconds=$(awk "BEGIN { printf \"%.1f\", $EPOCHREALTIME - $began }")
    rows+=("$name"$'\t'"$seconds"$'\t'"$(summarize "$labels")")
  elif [[ $result -eq 4 ]]; then
    rows+=("$name"$'\t-\t-\t-\t'"no solid found, see above")
    [[ -z ${INPUT:-} ]] || status=4
  else
    rows+=("$name"$'\t-\t-\t-\t'"failed with exit status $result")
    status=$result
  fi
}

if [[ -n ${INPUT:-} ]]; then
  read -r -a options <<<"${ARGS:-}"
  segment "$INPUT" "${options[@]}"
else
  data=build/demo-data
  scripts/fetch-demo-data.sh "$data"
  segment "$data/meshes/bull.off" --sample 20000 --noise 0.003
  segment "$data/meshes/triceratops.off" --sample 20000 --noise 0.003
  segment "$data/points_3/kitten.xyz"
  segment "$data/meshes/pig.off" --sample 20000
  segment "$data/points_3/hippo1.ply"
fi

echo
printf '%-18s %8s %6s %8s  %s\n' input points parts seconds "shares of the points"
for row in "${rows[@]}"; do
  IFS=$'\t' read -r name seconds points parts shares <<<"$row"
  printf '%-18s %8s %6s %8s  %s\n' "$name" "$points" "$parts" "$seconds" "$shares"
done
echo
if [[ $status -eq 0 ]]; then
  echo "Look at $out/*.html (in a browser), $out/*.png (pictures), $out/*_parts.ply (points with colour and part number," \
    "for MeshLab or CloudCompare) and $out/*.json (reports)."
fi
exit "$status"
