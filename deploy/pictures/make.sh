#!/usr/bin/env bash
# Draws the README's pictures anew: the data path, the HPC map with the reference points where they are at hand, and the
# estimates of one demo flight against the truth.
# Usage: deploy/pictures/make.sh [NPSS_CASES.csv]     (graphviz and gnuplot-nox; the flight takes 30 s)
set -euo pipefail
cd "$(dirname "$0")/../.."
deploy/install-deps.sh
dot -Tsvg deploy/pictures/data_path.dot -o deploy/pictures/data_path.svg
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
csv=$folder/flight.csv
EHM_DEMO_CSV=$csv deploy/demo.sh --seconds 30
gnuplot -e "csv='$csv'; out='deploy/pictures/estimate.svg'" deploy/pictures/estimate.gp
"${EHM_BUILD_DIR:-build}/engine_sim/engine_sim" maps --out "$folder" ${1:+--reference "$1"}
cp "$folder/hpc.svg" deploy/pictures/hpc_map.svg
