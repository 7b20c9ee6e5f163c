#!/usr/bin/env bash
# Configures and builds, incrementally. Usage: deploy/build.sh BUILD_DIR [TARGET ...]; more for CMake in EHM_CMAKE_ARGS.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
shift
targets=()
[ $# -eq 0 ] || targets=(--target "$@")
# shellcheck disable=SC2086  # several arguments on purpose
cmake -S . -B "$build" -G Ninja ${EHM_CMAKE_ARGS:-} >"/dev/null"
cmake --build "$build" "${targets[@]}"
