#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Three monitors of ten engines each on three hosts (network namespaces), one partition a host, discovery by a Discovery
# Server on a fourth. One monitor is killed and comes back: the other two must not notice. Prints a table.
# Usage: namespaces.sh BUILD_DIR DESIGN_FILE
# Exit:  0 as it should be, 1 not, 77 this machine permits no network namespaces
set -euo pipefail
build=$(realpath "$1")
design=$(realpath "$2")
here=$(realpath "$(dirname "$0")")
tag=ehm$$
engines=10 rate=66.7 # samples a second of each engine
work=$(mktemp -d "${TMPDIR:-/tmp}/ehm-fleet.XXXXXX")
children=()

clean_up() {
  for child in "${children[@]}"; do kill "$child" 2>/dev/null || true; done
  wait 2>/dev/null || true
  for i in 0 1 2 3; do ip netns del "$tag-$i" 2>/dev/null || true; done
  rm -rf "$work"
}
trap clean_up EXIT

if ! ip netns add "$tag-0" 2>"$work/netns.log"; then
  echo "namespaces: skipped, no network namespaces here: $(cat "$work/netns.log")"
  exit 77
fi
command -v fast-discovery-server >/dev/null || { echo "namespaces: skipped, fast-discovery-server is not installed"; exit 77; }

# Host 0 holds the bridge; hosts 1 to 3 hang on it.
on() { ip netns exec "$tag-$1" "${@:2}"; }
on 0 ip link set lo up
on 0 ip link add bridge type bridge
on 0 ip addr add 10.77.0.10/24 dev bridge
on 0 ip link set bridge up
for i in 1 2 3; do
  ip netns add "$tag-$i"
  ip -n "$tag-0" link add "port$i" type veth peer name eth0 netns "$tag-$i"
  on 0 ip link set "port$i" master bridge up
  on "$i" ip addr add "10.77.0.1$i/24" dev eth0
  on "$i" ip link set eth0 up
  on "$i" ip link set lo up
done
sed "s/SERVER_ADDRESS/10.77.0.10/" "$here/../../deploy/dds/discovery_client.xml" >"$work/client.xml"

start() { setpriv --pdeathsig TERM -- "$@" & children+=($!); }
start_monitor() {
  start ip netns exec "$tag-$1" "$build/monitor/monitor" --monitor-design "$design" --monitor-source-id "10$1" \
    --dds-partition "fleet/$1" --dds-profiles-file "$work/client.xml" --log-level error
  monitor[$1]=$!
}
start ip netns exec "$tag-0" fast-discovery-server -i 0 -l 10.77.0.10 -p 11811 >"$work/server.log" 2>&1
declare -A monitor
for i in 1 2 3; do
  start_monitor "$i"
  start ip netns exec "$tag-$i" "$build/tests/bench/fleet_replay" --design "$design" --engines "$engines" \
    --first-id $((100 * i)) --partition "fleet/$i" --profiles-file "$work/client.xml" --seconds 120 >/dev/null
done

# watch PHASE: what a subscriber on host 0 hears of all partitions.
watch() { on 0 "$build/tests/fleet/fleet_watch" --profiles-file "$work/client.xml" --title "$1" --seconds 4 | tee -a "$work/table"; }
# estimates PHASE MONITOR: estimates a second in that phase, 0 if nothing was heard.
estimates() { awk -v m="$2" 'index($0, phase) == 1 && $0 ~ "monitor " m " " { for (i = 1; i < NF; ++i) if ($i == "estimates/s") r = $(i + 1) } END { print r + 0 }' phase="$1" "$work/table"; }
gaps() { awk -v m="$2" 'index($0, phase) == 1 && $0 ~ "monitor " m " " { for (i = 1; i < NF; ++i) if ($i == "gaps") r = $(i + 1) } END { print r + 0 }' phase="$1" "$work/table"; }
failures=0
check() { awk "BEGIN { exit !($2) }" || { echo "namespaces: not as it should be: $1 ($2)"; failures=$((failures + 1)); }; }

# all up: awaited, since discovery takes its time
for attempt in 1 2 3 4 5; do
  : >"$work/table"
  watch "all up" >/dev/null
  [ "$(grep -c "engines $engines " "$work/table" || true)" -eq 3 ] && break
done
cat "$work/table"
{ kill -9 "${monitor[2]}" && wait "${monitor[2]}"; } 2>/dev/null || true
watch "102 killed"
start_monitor 2
for attempt in 1 2 3; do
  watch "102 restarted" >/dev/null
  [ "$(estimates "102 restarted" 102)" != 0 ] && break
done
grep "^102 restarted" "$work/table" | tail -3

# Half the rate is asked for: the machine may be busy, but whoever was not killed goes on and loses nothing.
full="> 0.5 * $engines * $rate"
for phase in "all up" "102 killed" "102 restarted"; do
  for m in 101 103; do
    check "$phase, $m goes on" "$(estimates "$phase" $m) $full"
    check "$phase, $m loses nothing" "$(gaps "$phase" $m) == 0"
  done
done
check "102 estimates while all are up" "$(estimates "all up" 102) $full"
check "102 is silent when killed" "$(estimates "102 killed" 102) == 0"
check "102 estimates again" "$(estimates "102 restarted" 102) $full"
[ "$failures" -eq 0 ] && echo "namespaces: 3 monitors x $engines engines; the death of one touched its own partition only"
exit $((failures > 0))
