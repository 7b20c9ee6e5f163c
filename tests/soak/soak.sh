#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Soaks the pair: tests/soak/soak.sh --duration 10m|72h [--criteria FILE] [--json] [--accelerated]; --help tells all.
set -euo pipefail
exec python3 -B "$(dirname "$0")/soak.py" "$@"
