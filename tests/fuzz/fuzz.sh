#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the fuzz targets with clang and libFuzzer (preset asan) and runs each for a while on its kept corpus. What breaks a promise
# is written to BUILD/findings/TARGET and fails the run; put such an input into tests/fuzz/corpus/TARGET with the fix.
# Usage: tests/fuzz/fuzz.sh [--seconds N] [--jobs N] [--merge] [TARGET...]
#   --seconds  of each target (600)       --jobs   targets at a time (1)
#   --merge    keep, in tests/fuzz/corpus, what the run found that covers something new and is small (at most 4 kB)
set -euo pipefail
cd "$(dirname "$0")/../.."

seconds=600 jobs=1 merge=no
all=(monitor_config scenario engine design model import_mat import_csv checkpoint history samples wire_sample)
targets=()
while [ $# -gt 0 ]; do
  case "$1" in
    --seconds|--jobs)
      [[ "${2:-}" =~ ^[1-9][0-9]*$ ]] || { echo "fuzz.sh: $1 is '${2:-}', allowed is a whole number from 1" >&2; exit 2; }
      [ "$1" = --seconds ] && seconds=$2 || jobs=$2
      shift 2 ;;
    --merge) merge=yes; shift ;;
    *)
      [[ " ${all[*]} " == *" $1 "* ]] || { echo "fuzz.sh: unknown target or option '$1'; targets are ${all[*]}" >&2; exit 2; }
      targets+=("$1"); shift ;;
  esac
done
[ ${#targets[@]} -gt 0 ] || targets=("${all[@]}")
command -v clang++ > /dev/null || { echo "fuzz.sh: clang++ is missing: deploy/install-deps.sh --full" >&2; exit 2; }

build=${EHM_BUILD_DIR:-build}-asan
cmake --preset asan -S . -B "$build" > /dev/null
ninja -C "$build" "${targets[@]/#/fuzz_}"
build=$(cd "$build" && pwd)
# What grows is found in BUILD/corpus; the sources keep only what is merged.
export ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1

run_one() {
  local target=$1 log=$build/findings/$1.log
  mkdir -p "$build/corpus/$target" "$build/findings/$target"
  local status=passed
  "$build/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=3000 -max_len=65536 \
    -print_final_stats=1 -artifact_prefix="$build/findings/$target/" \
    "$build/corpus/$target" "tests/fuzz/corpus/$target" > "$log" 2>&1 || status=FAILED
  local runs rate coverage
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
  coverage=$(grep -oE 'cov: [0-9]+ ft: [0-9]+ corp: [0-9]+' "$log" | tail -1)
  printf '%-15s %-7s %10s runs %7s/s  %s\n' "$target" "$status" "${runs:-?}" "${rate:-?}" "$coverage"
  [ "$status" = passed ] || { tail -25 "$log"; return 1; }
}

failed=0
running=0
for target in "${targets[@]}"; do
  run_one "$target" & running=$((running + 1))
  if [ "$running" -ge "$jobs" ]; then wait -n || failed=1; running=$((running - 1)); fi
done
while [ "$running" -gt 0 ]; do wait -n || failed=1; running=$((running - 1)); done

if [ "$merge" = yes ]; then
  for target in "${targets[@]}"; do
    find "$build/corpus/$target" -type f -size -4k -exec cp -t "$build/findings/$target" {} +
    "$build/tests/fuzz/fuzz_$target" -merge=1 "tests/fuzz/corpus/$target" "$build/findings/$target" > /dev/null 2>&1 || failed=1
  done
fi
exit "$failed"
