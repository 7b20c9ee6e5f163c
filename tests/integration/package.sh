#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs into an empty prefix, builds the examples against it by find_package alone, lets each subscriber print an
# estimate of a live pair, and lets the sensor source in C take the simulator's place. Usage: package.sh BUILD_DIR DESIGN_FILE
set -euo pipefail
build=$(realpath "$1")
design=$(realpath "$2")
examples=$(realpath "$(dirname "$0")/../../deploy/examples")
work=$(mktemp -d "${TMPDIR:-/tmp}/ehm-package.XXXXXX")
domain=$((201 + $$ % 30))
children=()
clean_up() {
  for child in "${children[@]}"; do kill "$child" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$work"
}
trap clean_up EXIT

cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
for example in subscriber_cpp subscriber_c sensor_source_c; do
  cmake -S "$examples/$example" -B "$work/$example" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/$example.log"
  cmake --build "$work/$example" >>"$work/$example.log" || { cat "$work/$example.log"; exit 1; }
done

start() { setpriv --pdeathsig TERM -- "$@" & children+=($!); }
start "$work/prefix/bin/monitor" --monitor-design "$design" --dds-domain "$domain" --log-level warn
start "$work/prefix/bin/engine_sim" --dds-domain "$domain" --run-wait-for-monitors 1 --log-level warn
for program in subscriber_cpp/health_subscriber subscriber_c/health_subscriber_c; do
  grep -m1 -E '^engine 1 sample [0-9]+: .*-?[0-9.]+ \+- [0-9.]+' < <(timeout 20 "$work/$program" "$domain" 2>&1) || {
    echo "package: $program printed no estimate"
    exit 1
  }
done

start "$work/sensor_source_c/sensor_source_c" -d "$domain" -e 2 "$examples/sensor_source_c/jt9d_cruise.csv"
"$work/prefix/bin/monitor" --monitor-design "$design" --dds-domain "$domain" --listen --seconds 2 |
  grep -E '^engine 2, source 1: [0-9]+ samples|^verdict: OK' || { echo "package: the sensor source is not heard"; exit 1; }
echo "package: the examples read the installed services and feed them"
