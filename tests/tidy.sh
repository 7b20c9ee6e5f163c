#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the checks of .clang-tidy on the sources of the programs and of what they link; a finding fails it.
# Usage: tests/tidy.sh [BUILD_DIR [SOURCE...]]   default build, which must be configured; all sources but those of tests
# Exit:  0 nothing found, 1 findings or a source that clang cannot read (shown), 2 wrong usage
set -euo pipefail
cd "$(dirname "$0")/.."

build=${1:-build}
[ $# -eq 0 ] || shift
command -v clang-tidy >/dev/null || { echo "tidy.sh: clang-tidy is missing: deploy/install-deps.sh --full" >&2; exit 2; }
[ -f "$build/compile_commands.json" ] || { echo "tidy.sh: '$build' is not configured: deploy/build.sh $build" >&2; exit 2; }

sources=("$@")
[ ${#sources[@]} -gt 0 ] || mapfile -t sources < <(git ls-files 'engine_sim/*.cpp' 'monitor/*.cpp' 'tuner_design/*.cpp' \
  'deploy/runtime/*.cpp' 'deploy/client/*.cpp' 'deploy/command/*.cpp' 'deploy/demo/*.cpp' 'idl/dds/*.cpp')
printf '%s\0' "${sources[@]}" |
  xargs -0 -P "$(nproc)" -n 4 clang-tidy -p "$build" --quiet 2> >(grep -v 'warnings\? generated' >&2) ||
  { echo "tidy.sh: findings above, in some of ${#sources[@]} sources" >&2; exit 1; }
echo "tidy.sh: ${#sources[@]} sources, nothing found"
