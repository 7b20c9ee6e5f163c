#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The packages in a Debian of their own: built, checked by lintian, installed with apt into a fresh bookworm, run as their
# users, upgraded over a changed configuration, removed, purged. Prints a line a check.
# Usage: packages.sh BUILD_DIR      as root; EHM_DEBIAN_MIRROR names a mirror, else the host's own apt sources do
# Exit: 0 all passed, 1 a check failed, 77 this host cannot do it (the message says why)
set -euo pipefail
here=$(realpath "$(dirname "$0")")
build=$(realpath "$1")
skip() { echo "packages: skipped: $*"; exit 77; }
fail() { echo "packages: FAILED: $*"; exit 1; }
passed() { echo "packages: ok: $*"; }

[ "$(id -u)" -eq 0 ] || skip "a chroot needs root"
for tool in debootstrap lintian dpkg-deb unshare; do
  command -v "$tool" >/dev/null || skip "$tool is missing; deploy/install-deps.sh --full installs it"
done
of_apt() {
  apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(CREATED_BY)' |
    awk '$2 ~ /^(bookworm|stable)$/ && $3 == "Packages" && !found {print $1; found = 1}'
}
mirror=${EHM_DEBIAN_MIRROR:-$(of_apt)}
[ -n "$mirror" ] || skip "no Debian mirror of bookworm in the apt sources; name one in EHM_DEBIAN_MIRROR"
unshare --mount --pid --fork true 2>/dev/null || skip "this container may not make a mount namespace"

work=$(mktemp -d "$build/packages-test.XXXXXX")
trap 'rm -rf --one-file-system "$work"' EXIT
root=$work/root

# inside COMMAND...: in the chroot, in a mount and a process namespace: what it mounts or starts ends with it.
inside() {
  unshare --mount --pid --fork --kill-child -- sh -c 'mount -t proc proc "$0/proc" && exec chroot "$0" "$@"' "$root" \
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C DEBIAN_FRONTEND=noninteractive "$@"
}
apt() {
  inside apt-get -y -qq -o Dpkg::Use-Pty=0 "$@" >>"$work/apt.log" 2>&1 && return
  tail -n 30 "$work/apt.log"
  fail "apt-get $*"
}
# Every path of the system but what apt, dpkg and the log keep for themselves, and the backups of the user database.
paths() {
  (cd "$root" && find . -xdev -print | grep -vE '^\./(proc|tmp|packages|var/cache|var/log|var/lib/(apt|dpkg)|etc/[^/]*-$|etc/\.pwd\.lock)' | sort)
}
version_of() { inside dpkg-query -W -f='${Version}' "$1"; }

# The packages, and a next version of them whose shipped configuration differs.
rm -f "$build"/packages/*.deb
cmake --build "$build" --target deb >"$work/build.log" 2>&1 ||
  { tail -n 20 "$work/build.log"; fail "the packages do not build"; }
debs=("$build"/packages/ehm-{monitor,engine-sim,tools,dev}_*.deb)
architecture=$(dpkg --print-architecture)
version=$(dpkg-deb -f "${debs[0]}" Version)
next=${version%.*}.$((${version##*.} + 1))
lintian --no-cfg --allow-root --fail-on error "${debs[@]}" >"$work/lintian" ||
  { cat "$work/lintian"; fail "lintian found errors"; }
dpkg-deb -c "${debs[3]}" >"$work/contents"
for example in subscriber_c subscriber_cpp sensor_source_c; do
  grep -q " ./usr/share/doc/ehm-dev/examples/$example/CMakeLists.txt$" "$work/contents" ||
    fail "ehm-dev has no example $example"
done
passed "lintian: no error, $(grep -c '^W:' "$work/lintian" || true) warnings in ${#debs[@]} packages"
mkdir -p "$work/next"
for deb in "${debs[@]:0:3}"; do
  dpkg-deb -R "$deb" "$work/unpacked"
  sed -i "s/^Version: .*/Version: $next/" "$work/unpacked/DEBIAN/control"
  for conffile in "$work"/unpacked/etc/ehm/* "$work"/unpacked/etc/default/*; do
    [ ! -e "$conffile" ] || echo "# new in $next" >>"$conffile"
  done
  dpkg-deb --root-owner-group -b "$work/unpacked" "$work/next" >/dev/null
  rm -rf "$work/unpacked"
done

debootstrap --variant=minbase bookworm "$root" "$mirror" >"$work/debootstrap.log" 2>&1 ||
  { tail -n 5 "$work/debootstrap.log"; skip "debootstrap from the configured mirror failed"; }
cp /etc/resolv.conf "$root/etc/resolv.conf"
mkdir "$root/packages"
cp "${debs[@]:0:3}" "$root/packages/"
cp -r "$work/next" "$here/in_chroot.sh" "$here/in_booted.sh" "$root/packages/"
apt update
for deb in "${debs[@]:0:3}"; do apt satisfy "$(dpkg-deb -f "$deb" Depends)"; done
apt install --no-install-recommends openssl  # which make_security.sh needs: recommended by ehm-tools
paths >"$work/before"

install_all() { apt install --no-install-recommends /packages/ehm-{monitor,engine-sim,tools}_"${version}_$architecture.deb"; }
install_all
[ "$(version_of ehm-monitor)" = "$version" ] || fail "version $(version_of ehm-monitor) is installed, not $version"
for user in ehm ehm-sim; do grep -q "^$user:.*nologin" "$root/etc/passwd" || fail "no user $user without a login"; done
[ -z "$(find "$root"/etc/systemd/system -name 'ehm-*')" ] || fail "installing enabled a service"
added=$(comm -13 "$work/before" <(paths) | wc -l)
[ "$added" -gt 20 ] || fail "the list of paths notices only $added new ones"
passed "apt installed $version with its dependencies: $added paths, users ehm and ehm-sim, nothing started"

inside sh /packages/in_chroot.sh $((201 + $$ % 30)) || fail "the installed pair"

# What a user changed stays; what he did not change is renewed; state stays.
sed -i 's/^max = 1380.0/max = 1390.0  # ours/' "$root/etc/ehm/monitor.toml"
touch "$root/var/lib/ehm/state"
apt install -o Dpkg::Options::=--force-confold --no-install-recommends /packages/next/ehm-{monitor,engine-sim,tools}_"${next}_$architecture.deb"
[ "$(version_of ehm-monitor)" = "$next" ] || fail "version $(version_of ehm-monitor) after the upgrade, not $next"
grep -q '# ours' "$root/etc/ehm/monitor.toml" || fail "the upgrade lost a changed configuration"
grep -q "new in $next" "$root/etc/ehm/monitor.toml.dpkg-dist" || fail "the new configuration does not lie beside the changed one"
grep -q "new in $next" "$root/etc/ehm/engine_sim.toml" || fail "the upgrade kept an unchanged configuration"
[ -e "$root/var/lib/ehm/state" ] || fail "the upgrade lost the state"
passed "upgrade to $next: changed configuration and state kept, unchanged configuration renewed"

apt remove ehm-monitor ehm-engine-sim ehm-tools
[ -e "$root/etc/ehm/monitor.toml" ] && [ -e "$root/var/lib/ehm/state" ] || fail "remove took configuration or state"
ln -s /lib/systemd/system/ehm-monitor.service "$root/etc/systemd/system/multi-user.target.wants/ehm-monitor.service"
touch "$root/var/lib/ehm/engine_1.json" "$root/var/lib/ehm/flight.h5"
rm "$root/var/lib/ehm/state"
apt purge ehm-monitor ehm-engine-sim ehm-tools
left=$(comm -13 "$work/before" <(paths))
[ "$(grep -c . <<<"$left")" = 2 ] && [ -e "$root/var/lib/ehm/flight.h5" ] || fail "purge left $left"
[ "$(grep -cE '^ehm(-sim)?:' "$root/etc/passwd")" = 2 ] || fail "purge took a user, whose number the next one gets"
rm -r "$root/var/lib/ehm"
passed "remove kept configuration and state; purge left recordings and users, and nothing else"

# Once more under a systemd of its own: the units as shipped.
install_all
"$here/boot.sh" "$root" bash /packages/in_booted.sh /packages/next || booted=$?
case ${booted:-0} in
  0) ;;
  77) echo "packages: the units were not started: this host cannot boot a systemd of its own" ;;
  *) fail "the units under systemd" ;;
esac
