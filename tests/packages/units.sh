#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The units are correct (systemd-analyze verify), and their sandbox is at most 2.0 on its scale from 0 (safe) to 10. Each
# check is seen to fail on a unit that deserves it. Usage: units.sh FOLDER_OF_UNITS PROGRAM_FOLDER...
set -euo pipefail
units=$(realpath "$1")
shift
work=$(mktemp -d "${TMPDIR:-/tmp}/ehm-units.XXXXXX")
trap 'rm -rf "$work"' EXIT
fail() { echo "units: $*"; exit 1; }

# A root in which the programs stand where the packages put them, beside the host's own systemd units.
root=$work/root
folder=$root/etc/systemd/system
mkdir -p "$folder" "$root/usr/bin" "$root/bin" "$root/usr/lib/systemd" "$root/usr/share/doc/ehm-monitor"
for program in "$@"; do install -m 755 "$program" "$root/usr/bin/"; done
install -m 755 /bin/kill "$root/bin/"
cp -r /lib/systemd/system "$root/usr/lib/systemd/"
cp "$units"/*.service "$folder/"

# verify UNIT: prints what is wrong with that unit of ours; nothing if it is right.
verify() { systemd-analyze verify --man=no --root="$root" "$folder/$1" 2>&1 | grep -F ehm- || true; }
exposed() { systemd-analyze security --offline=yes --no-pager --threshold="$2" "$1" >"$work/security"; }

for unit in ehm-monitor.service ehm-monitor@standby.service ehm-engine-sim.service; do
  found=$(verify "$unit")
  [ -z "$found" ] || fail "$unit: $found"
done
for unit in "$units"/*.service; do
  exposed "$unit" 20 || fail "$(basename "$unit") is over 2.0: $(tail -n 1 "$work/security")"
  tail -n 1 "$work/security"
done

# The template says the same as the unit but for the names that hold the instance's.
same=$(diff <(sed -E 's|[-/]%i||; s| %i||' "$units/ehm-monitor@.service") "$units/ehm-monitor.service" || true)
[ -z "$same" ] || fail "the template differs: $same"
for unit in "$units"/*.service; do
  for line in Type=notify 'WatchdogSec=[0-9]' 'User=ehm' Restart=on-failure RestartPreventExitStatus=2 StartLimitBurst= LimitMEMLOCK=; do
    grep -q "^$line" "$unit" || fail "$(basename "$unit") has no $line"
  done
done
grep -q '^After=.*ehm-monitor.service' "$units/ehm-engine-sim.service" || fail "the simulator may start before the monitor"

# Negative: a unit without its file system protection and with root's capabilities is over 2.0 ...
sed -E '/^(ProtectSystem|CapabilityBoundingSet|User|SystemCallFilter)=/d' "$units/ehm-monitor.service" >"$work/weak.service"
! exposed "$work/weak.service" 20 || fail "a weakened unit passes"
# ... and a misspelt key, and a program that does not exist, are found.
sed 's/^WatchdogSec=/WatchdogSecs=/' "$units/ehm-monitor.service" >"$folder/ehm-wrong-key.service"
[ -n "$(verify ehm-wrong-key.service)" ] || fail "a misspelt key passes"
sed 's|/usr/bin/monitor|/usr/bin/no-such-program|' "$units/ehm-monitor.service" >"$folder/ehm-no-program.service"
[ -n "$(verify ehm-no-program.service)" ] || fail "a program that does not exist passes"
echo "units: correct, at most 2.0, and weak or wrong ones are refused"
