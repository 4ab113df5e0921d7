#!/usr/bin/env bash
# Fuzzes the targets of fuzz/ with libFuzzer under address and undefined-behaviour sanitizers.
#   scripts/fuzz.sh [--seconds N] [TARGET…]    N seconds of processor time each, 60 if not given; all
#                                              targets if none is named
# What it learns stays in build/fuzz/corpus; an input that breaks a target goes to build/fuzz/findings
# and ends this script with status 1. Once mended, it belongs into fuzz/corpus/TARGET.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=60
if [[ ${1-} == --seconds ]]; then
  seconds=$2
  shift 2
fi
scripts/install-dependencies.sh --fuzz
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
program=build/fuzz/fuzz/morsel_fuzz
if [[ $# -gt 0 ]]; then targets=("$@"); else mapfile -t targets < <(ls fuzz/corpus); fi
findings=build/fuzz/findings
mkdir -p "$findings"
export ASAN_OPTIONS=detect_stack_use_after_return=1:allocator_may_return_null=0
export UBSAN_OPTIONS=print_stacktrace=1
export ASAN_SYMBOLIZER_PATH=${ASAN_SYMBOLIZER_PATH:-$(command -v llvm-symbolizer-16 || true)}
[[ -d /dev/shm ]] && export TMPDIR=/dev/shm # databases are written to disk at every change

# The processor time counts, however busy the machine is: as many slices as it takes. Each is as long as what
# is left, since a slice begins by running all that was learned.
TIMEFORMAT='%U %S'
for target in "${targets[@]}"; do
  learned=build/fuzz/corpus/$target
  log=build/fuzz/$target.log
  mkdir -p "$learned"
  used=0 runs=0
  while ((used < seconds)); do
    slice=$((seconds - used > 30 ? seconds - used : 30))
    if ! { time "$program" "--target=$target" -max_total_time="$slice" -timeout=120 \
      -rss_limit_mb=3000 -max_len=20000 -print_final_stats=1 -verbosity=1 \
      -artifact_prefix="$findings/$target-" "$learned" "fuzz/corpus/$target" tests/corpus/bad \
      >"$log" 2>&1; } 2>"$log.time"; then
      grep -E '^(ERROR|==|SUMMARY|broken|artifact)|runtime error' "$log" | tail -8 || tail -5 "$log"
      echo "$target: broken; see $log and $findings" >&2
      exit 1
    fi
    used=$((used + $(awk '{ printf "%d", $1 + $2 + 0.999 }' "$log.time")))
    runs=$((runs + $(awk '/number_of_executed_units/ { print $2 }' "$log")))
  done
  echo "$target: $runs runs in $used s of processor time"
done
