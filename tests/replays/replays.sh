#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What earlier versions recorded is estimated today as it was then: every estimate to the bit, every event with its text.
# A folder beside this script holds flight.h5 (a monitor's recording), design.json (what flew), events.txt (what the
# monitor said) and scenario.toml (what engine_sim flew). A change that alters estimates on purpose makes them anew:
#   engine_sim --config scenario.toml --run-duration-s 24 --rate max, with monitor --monitor-clock source --record flight.h5
# Usage: replays.sh MONITOR WORK_FOLDER
set -euo pipefail
monitor=$1 work=$2
cd "$(dirname "$0")"
mkdir -p "$work"

broken=0
for folder in */; do
  name=${folder%/}
  rm -f "$work/$name".*
  "$monitor" --monitor-design "$name/design.json" --offline "$name/flight.h5" --out "$work/$name.h5" \
    > "$work/$name.said" 2> "$work/$name.log"
  if ! grep -qE '^estimates of the input: [1-9][0-9]* identical to the bit, 0 different$' "$work/$name.said"; then
    echo "replays: $name: other estimates than when it was recorded:"; cat "$work/$name.said"; broken=1
  fi
  sed -E 's/^(\[[^]]*\] ){3}//' "$work/$name.log" > "$work/$name.events"
  if ! diff "$name/events.txt" "$work/$name.events"; then echo "replays: $name: other events (< then, > now)"; broken=1; fi
  cat "$work/$name.said"
done
exit $broken
