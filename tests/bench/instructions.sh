#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Prints the mean number of machine instructions of one step of the transient, counted by callgrind over slams at three
# flight conditions. The figure is the same in every run of one build, on a busy machine too.
# Usage: tests/bench/instructions.sh [BUILD_FOLDER]     (default build)
# Exit:  0 printed, 1 callgrind failed, 2 something is missing (the message names it)
set -euo pipefail
build=${1:-build}
program=$build/tests/bench/slam_steps
command -v valgrind >/dev/null || { echo "instructions.sh: valgrind is missing; run deploy/install-deps.sh" >&2; exit 2; }
[ -x "$program" ] || { echo "instructions.sh: $program is missing; build the target slam_steps" >&2; exit 2; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
if ! valgrind --tool=callgrind --toggle-collect='ehm::engine_sim::SlamFlight::step()' \
  --callgrind-out-file="$folder/counts" "$program" >"$folder/out" 2>"$folder/log"; then
  cat "$folder/log" >&2
  exit 1
fi
steps=$(cut -d' ' -f1 "$folder/out")
total=$(sed -n 's/^totals: *//p' "$folder/counts")
[ "${total:-0}" -gt 0 ] || { echo "instructions.sh: callgrind counted nothing" >&2; exit 1; }
echo "$((total / steps)) instructions a step, mean of $steps steps"
