#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what building, running and testing needs, on a bare Debian 12. This is the one list of packages.
# Usage: deploy/install-deps.sh [--full]   as root, or as a user who may run sudo; --full adds what only
#        ./tests/run.sh --full needs
# Exit:  0 all present, 1 something could not be installed (the message names it), 2 wrong usage
set -euo pipefail

packages=(
  # tool chain
  g++ cmake ninja-build pkg-config ccache python3 git ca-certificates
  # the chosen packages
  libeigen3-dev libfastrtps-dev libfastcdr-dev fastddsgen libnlopt-dev libnlopt-cxx-dev libspdlog-dev libfmt-dev
  libgtest-dev libgmock-dev
  # configuration, files, command line
  libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libcsv-dev libmatio-dev libhdf5-dev zlib1g-dev libssl-dev
  # a service: notification and watchdog, metrics
  libsystemd-dev prometheus-cpp-dev libcpp-httplib-dev
  # an independent DDS for the interoperability tests and the C example; Fast DDS' discovery server
  cyclonedds-dev cyclonedds-tools fastdds-tools
  # what the tests ask beside: certificates, unit files, manual pages, recordings read by others, hosts in network namespaces
  openssl systemd man-db python3-h5py python3-yaml iproute2 curl
  # measurements: tests/bench
  libbenchmark-dev valgrind
  # pictures of the documentation
  gnuplot-nox graphviz
)
# Only ./tests/run.sh --full needs these: fuzzers, and packages built and installed into a root of their own.
full_packages=(clang clang-tidy libclang-rt-14-dev llvm lintian debootstrap dpkg-dev fakeroot)

case "${1:-}" in
  "") ;;
  --full) packages+=("${full_packages[@]}") ;;
  *) echo "install-deps: unknown option '$1'; allowed is --full" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install-deps: missing packages: ${missing[*]}" >&2
    echo "install-deps: run this script as root, or install sudo" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "install-deps: installing ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq >&2
if ! "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2; then
  echo "install-deps: apt-get could not install: ${missing[*]}" >&2
  exit 1
fi
