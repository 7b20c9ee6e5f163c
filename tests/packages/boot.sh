#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Boots the systemd of a root folder in namespaces of its own (processes, mounts, network with loopback only, cgroups, so
# that it sees nothing of this host), and runs a script in it. All of it ends with this script.
# Usage: boot.sh ROOT COMMAND...     as root
# Exit: that of the command, 77 if this host cannot do it (the message says why)
set -euo pipefail
root=$(realpath "$1")
shift
skip() { echo "boot: skipped: $*"; exit 77; }

cgroups=$(findmnt -n -t cgroup2 -o TARGET | head -n 1)
[ -n "$cgroups" ] || skip "no cgroup2 is mounted"
group=$cgroups/ehm-boot.$$
mkdir "$group" 2>/dev/null || skip "$cgroups cannot be written"
host=
clean_up() {
  [ -z "$host" ] || { kill -KILL "$host"; wait "$host"; } 2>/dev/null || true
  # The kernel needs a moment to bury the last processes.
  for _ in $(seq 100); do find "$group" -depth -type d -exec rmdir {} + 2>/dev/null && break; sleep 0.05; done
}
trap clean_up EXIT

# As a container's manager does it: /proc/sys and /sys cannot be written, /dev has the harmless devices only.
boot='
set -eu
mount --make-rprivate /
mount --bind "$0" "$0"
cd "$0"
mount -t proc proc proc
mount --bind proc/sys proc/sys
mount -o remount,bind,ro proc/sys
mount -t sysfs -o ro sysfs sys
mount -t cgroup2 cgroup2 sys/fs/cgroup
mount -t tmpfs tmpfs run
mount -t tmpfs tmpfs dev
for device in null zero full random urandom tty; do touch "dev/$device"; mount --bind "/dev/$device" "dev/$device"; done
mkdir dev/pts dev/shm
ln -s /proc/self/fd dev/fd
ln -s pts/ptmx dev/ptmx
hostname ehm-boot
ip link set lo up
mkdir -p old
pivot_root . old
exec chroot . env -i container=chroot PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -c "
  umount -l /old && rmdir /old && exec /lib/systemd/systemd --system --unit=basic.target --log-target=journal"'
( echo "$BASHPID" >"$group/cgroup.procs"
  exec unshare --mount --pid --uts --ipc --net --cgroup --fork --kill-child -- sh -c "$boot" "$root" ) >"$root/tmp/boot.log" 2>&1 &
host=$!

inside() { nsenter -t "$init" -m -u -i -n -p -C -r -w -- env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C DEBIAN_FRONTEND=noninteractive "$@"; }
for _ in $(seq 200); do
  kill -0 "$host" 2>/dev/null || skip "systemd does not boot: $(tail -n 3 "$root/tmp/boot.log")"
  init=$(pgrep -P "$host" -x systemd || true)
  [ -n "$init" ] && inside test -S /run/systemd/private 2>/dev/null && break
  sleep 0.1
done
[ -n "$init" ] && inside test -S /run/systemd/private || skip "systemd does not answer: $(tail -n 3 "$root/tmp/boot.log")"
inside "$@"
