#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A hostile day: the pair as it is built, on a network and with disks of its own, under every attack of
# tests/hostile/day.py. Prints a line an attack: what was tried, and what was held, by numbers, or BROKEN.
# Usage: tests/hostile.sh BUILD_DIR [ATTACK...]      all attacks by default, some five minutes; --help lists them
# Exit:  0 all held, 1 one is broken, 2 wrong usage, 77 this machine permits no namespaces
set -euo pipefail
day=$(realpath "$(dirname "$0")")/hostile/day.py
case "${1:-}" in
  "" | -h | --help) exec python3 -B "$day" "${1:---help}" ;;
esac
[ -d "$1" ] || { echo "hostile.sh: '$1' is no folder; a build folder is asked for" >&2; exit 2; }
build=$(realpath "$1")
shift

# Whoever is not root becomes it within a namespace of users. All that was started ends with the first process.
alone=(unshare --net --mount --pid --fork --kill-child --mount-proc)
[ "$(id -u)" -eq 0 ] || alone+=(--user --map-root-user)
if ! reason=$("${alone[@]}" sh -c 'ip link set lo up && mount -t tmpfs tmpfs /mnt' 2>&1); then
  echo "hostile: skipped, no namespaces of network and mounts here: $reason"
  exit 77
fi
exec timeout --kill-after=10 600 "${alone[@]}" sh -c 'ip link set lo up && exec "$@"' sh python3 -B "$day" "$build" "$@"
