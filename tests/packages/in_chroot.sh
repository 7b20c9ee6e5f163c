#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Run inside the chroot by packages.sh: the installed pair with its shipped configuration, each as its user, on DDS.
# Usage: in_chroot.sh DOMAIN
set -eu
export EHM_DDS_DOMAIN="$1"
# exec, so that $! is the program itself and a signal reaches it
as() { user=$1; shift; exec setpriv --reuid="$user" --regid="$user" --init-groups -- "$@"; }
fail() { echo "packages: in the chroot: $*"; cat /tmp/monitor.log /tmp/engine_sim.log; head -c 3000 /tmp/watch.log; exit 1; }

for pair in ehm:monitor ehm-sim:engine_sim; do
  user=${pair%%:*}; program=${pair##*:}
  (as "$user" "$program" --config "/etc/ehm/$program.toml" --check-config) >/tmp/check.log 2>&1 || fail "$program refuses its shipped configuration"
done
# What the documents name is where they say.
for file in ehm-monitor/README.md ehm-monitor/security.md ehm-monitor/examples/primary.toml ehm-monitor/examples/standby.toml; do
  [ -s "/usr/share/doc/$file" ] || fail "/usr/share/doc/$file is missing"
done
secured() { sed 's/^#security/security/' "/etc/ehm/$1.toml" >"/tmp/$1.toml"; grep -q '^security_required = true' "/tmp/$1.toml"; }
for program in monitor engine_sim; do secured "$program" || fail "the shipped $program.toml does not show how it is secured"; done
check_secured() { (as "$1" "$2" --config "/tmp/$2.toml" --check-config) >/tmp/check.log 2>&1; }
check_secured ehm monitor && fail "a monitor without its identity is taken for secured"
/usr/share/ehm/security/make_security.sh --out /tmp/keys >/tmp/keys.log 2>&1 || { cat /tmp/keys.log; fail "make_security.sh ends with $?"; }
mkdir /etc/ehm/security
cp -r /tmp/keys/monitor /tmp/keys/sensor_source /etc/ehm/security/
chown -R ehm: /etc/ehm/security/monitor
chown -R ehm-sim: /etc/ehm/security/sensor_source
check_secured ehm monitor || { cat /tmp/check.log; fail "monitor refuses the identity that make_security.sh made"; }
check_secured ehm-sim engine_sim || { cat /tmp/check.log; fail "engine_sim refuses the identity that make_security.sh made"; }
rm -r /etc/ehm/security /tmp/keys
echo "packages: ok: documents and examples in their places; make_security.sh makes identities that the services take"

as ehm monitor --config /etc/ehm/monitor.toml 2>/tmp/monitor.log & monitor=$!
as ehm-sim engine_sim --config /etc/ehm/engine_sim.toml --run-wait-for-monitors 1 2>/tmp/engine_sim.log & simulator=$!
# Its verdict of 3 sigmas is chance for one in some thirty flights; what counts here is that estimates flow.
ehm_watch --domain "$1" --seconds 10 --timeout 60 --json >/tmp/watch.log 2>&1 || true
grep -q '"samples_lost": 0' /tmp/watch.log && grep -qE '"samples_received": [0-9]{3}' /tmp/watch.log || fail "no flow of estimates"
for program in monitor engine_sim; do
  status=$(grep -l "^Name:	$program\$" /proc/[0-9]*/status) || fail "$program is gone"
  grep -q '^Uid:	0	' $status && fail "$program runs as root"
done
kill -TERM "$simulator" "$monitor"
wait "$simulator" || fail "engine_sim ended with $?"
wait "$monitor" || fail "monitor ended with $?"
echo "packages: ok: the installed pair flew 10 s as ehm and ehm-sim, and lost nothing"
