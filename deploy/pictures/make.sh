#!/usr/bin/env bash
# Draws the README's pictures anew: the data path, and the estimates of one demo flight against the truth.
# Usage: deploy/pictures/make.sh      (graphviz and gnuplot-nox; the flight takes 30 s)
set -euo pipefail
cd "$(dirname "$0")/../.."
deploy/install-deps.sh
dot -Tsvg deploy/pictures/data_path.dot -o deploy/pictures/data_path.svg
csv=$(mktemp "${TMPDIR:-/tmp}/ehm-flight.XXXXXX.csv")
trap 'rm -f "$csv"' EXIT
EHM_DEMO_CSV=$csv deploy/demo.sh --seconds 30
gnuplot -e "csv='$csv'; out='deploy/pictures/estimate.svg'" deploy/pictures/estimate.gp
