#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Run by boot.sh under the systemd of the chroot, where the packages are installed: the units as they are shipped, with
# their whole sandbox. Usage: in_booted.sh FOLDER_OF_NEXT_PACKAGES
set -u
next=$1
fail() {
  echo "booted: FAILED: $*"
  systemctl --no-pager --lines=15 status ehm-monitor ehm-engine-sim ehm-monitor@standby
  exit 1
}
passed() { echo "booted: ok: $*"; }
property() { systemctl show -p "$2" --value "$1"; }
# until_true SECONDS COMMAND...
until_true() {
  local tries=$(($1 * 10))
  shift
  while ! "$@" >/dev/null 2>&1; do
    tries=$((tries - 1))
    [ "$tries" -gt 0 ] || return 1
    sleep 0.1
  done
}
new_process() { local pid; pid=$(property "$1" MainPID); [ "$pid" -gt 0 ] && [ "$pid" != "$2" ] && [ "$(property "$1" ActiveState)" = active ]; }
journal_has() { journalctl -u ehm-monitor | grep -q -- "$1"; }
health() { exec 3<>/dev/tcp/127.0.0.1/9477 && printf 'GET /health HTTP/1.0\r\n\r\n' >&3 && grep -q ' 200 ' <&3; }

systemctl is-system-running --wait >/dev/null
systemctl start ehm-monitor ehm-engine-sim || fail "the units do not start"
for unit in ehm-monitor:ehm ehm-engine-sim:ehm-sim; do
  status=/proc/$(property "${unit%:*}" MainPID)/status
  grep -q "^Uid:	$(id -u "${unit#*:}")	" "$status" || fail "${unit%:*} does not run as ${unit#*:}"
  grep -q '^CapEff:	0*$' "$status" && grep -q '^CapBnd:	0*$' "$status" || fail "${unit%:*} has capabilities"
  grep -q '^NoNewPrivs:	1' "$status" && grep -q '^Seccomp:	2' "$status" || fail "${unit%:*} has no system call filter"
done
ehm_watch --seconds 5 --timeout 60 --json >/tmp/watch.log 2>&1
grep -q '"samples_lost": 0' /tmp/watch.log && grep -qE '"samples_received": [0-9]{3}' /tmp/watch.log || { tail -n 3 /tmp/watch.log; fail "no flow of estimates"; }
until_true 5 health || fail "no healthy answer of the metrics port"
passed "units start (Type=notify), run without root and without capabilities, and estimate; the health endpoint says 200"

pid=$(property ehm-monitor MainPID)
# A host without CAP_SYS_RESOURCE cannot raise limits; the monitor then warns and flies on, as it does above.
limit=$(awk '/^Max realtime priority/ {print $5}' "/proc/$pid/limits")
if [ "$limit" = 80 ]; then
  threads=$(chrt --all-tasks --pid "$pid")
  echo "$threads" | grep -q SCHED_FIFO || fail "no thread has SCHED_FIFO: $(journalctl -u ehm-monitor | grep -i realtime)"
  echo "$threads" | grep -q SCHED_OTHER || fail "every thread has SCHED_FIFO"
  grep -q '^VmLck:.* [1-9][0-9]* kB' "/proc/$pid/status" || fail "memory is not locked"
  passed "without root: $(echo "$threads" | grep -c SCHED_FIFO) threads under SCHED_FIFO, memory locked"
else
  journal_has 'Remedy: raise the limit' || fail "nothing is said of the refused realtime keys"
  echo "booted: SCHED_FIFO not tried: this host grants the limit $limit, not 80; the monitor said so and flew"
fi

kill -KILL "$pid"
until_true 20 new_process ehm-monitor "$pid" || fail "no new start after kill -9"
pid=$(property ehm-monitor MainPID)
kill -STOP "$pid"
until_true 40 new_process ehm-monitor "$pid" || fail "no new start of a monitor that hangs"
[ "$(property ehm-monitor NRestarts)" = 2 ] || fail "$(property ehm-monitor NRestarts) restarts counted, not 2"
ls /var/lib/ehm/*engine*1* >/dev/null 2>&1 || fail "no checkpoint in $(ls -d /var/lib/ehm/*)"
passed "started anew after kill -9, and by the watchdog after a hang"

sed 's/^\[monitor\]/&\nsource_id = 102/; s|/var/lib/ehm|&/standby|' /etc/ehm/monitor.toml >/etc/ehm/monitor-standby.toml
systemctl start ehm-monitor@standby || fail "an instance does not start"
[ -d /var/lib/ehm/standby ] || fail "the instance has no folder of its own"
passed "an instance runs beside it"

systemctl reload ehm-monitor || fail "a good configuration is not reloaded"
until_true 10 journal_has 'configuration and designs reloaded' || fail "the monitor says nothing of the reload"
sed -i.good 's/^domain = .*/domian = 0/' /etc/ehm/monitor.toml
systemctl reload ehm-monitor 2>/dev/null && fail "systemctl reports the reload of a wrong configuration as done"
until_true 5 journal_has "did you mean 'dds.domain'" || fail "the journal does not say what is wrong with the reload"
mv /etc/ehm/monitor.toml.good /etc/ehm/monitor.toml
[ "$(property ehm-monitor ActiveState)" = active ] || fail "a refused reload ended the monitor"
passed "a reload is taken; a wrong one fails in systemctl, says why, and the old configuration flies on"

before=$(property ehm-monitor MainPID)
apt-get install -y -qq --allow-downgrades "$next"/ehm-monitor_*.deb >/tmp/upgrade.log 2>&1 || { cat /tmp/upgrade.log; fail "upgrade"; }
new_process ehm-monitor "$before" || fail "the upgrade left the old program running"
[ "$(property ehm-monitor@standby ActiveState)" = active ] || fail "the upgrade stopped the instance"
passed "an upgrade restarts what runs"

systemctl stop ehm-monitor@standby ehm-monitor
sed -i 's/^domain = .*/domain = 999/' /etc/ehm/monitor.toml
systemctl start ehm-monitor 2>/dev/null && fail "a wrong configuration starts"
[ "$(property ehm-monitor ExecMainStatus)" = 2 ] || fail "exit code $(property ehm-monitor ExecMainStatus), not 2"
[ "$(property ehm-monitor ActiveState)" = failed ] || fail "a wrong configuration is started again and again"
journal_has "'dds.domain' is 999" || fail "the journal does not name the wrong key"
passed "a wrong configuration ends with 2, is not started again, and the journal names the key"

systemctl enable ehm-monitor >/dev/null 2>&1
apt-get purge -y -qq ehm-monitor ehm-engine-sim ehm-tools >/tmp/purge.log 2>&1 || { cat /tmp/purge.log; fail "purge"; }
pgrep_by_name() { grep -l -E '^Name:	(monitor|engine_sim)$' /proc/[0-9]*/status; }
pgrep_by_name >/dev/null 2>&1 && fail "purge left a process"
[ -z "$(find /etc/systemd/system /var/lib/ehm -name '*ehm*' 2>/dev/null)" ] || fail "purge left a unit or state"
passed "purge stops the services and leaves no unit"
