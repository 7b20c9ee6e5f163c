#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Configures and builds, incrementally. Usage: deploy/build.sh [BUILD_DIR [TARGET ...]]; default build, all targets.
# EHM_PRESET names a preset of CMakePresets.json; more for CMake in EHM_CMAKE_ARGS.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}
[ $# -eq 0 ] || shift
targets=()
[ $# -eq 0 ] || targets=(--target "$@")
# shellcheck disable=SC2086  # several arguments on purpose
cmake ${EHM_PRESET:+--preset "$EHM_PRESET"} -S . -B "$build" -G Ninja ${EHM_CMAKE_ARGS:-} >"/dev/null"
cmake --build "$build" "${targets[@]}"
