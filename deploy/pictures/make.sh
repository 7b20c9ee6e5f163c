#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Draws the documents' pictures anew: the data path, the HPC map with the reference points where they are at hand, the
# estimates of the demo's flights against the truth by each estimator, what the closed form is worth, and every estimator
# in every case.
# Usage: deploy/pictures/make.sh [NPSS_CASES.csv]     (graphviz and gnuplot-nox; the flights take 30 and 72 s each,
#        every estimator in every case a quarter of an hour)
set -euo pipefail
cd "$(dirname "$0")/../.."
deploy/install-deps.sh
dot -Tsvg deploy/pictures/data_path.dot -o deploy/pictures/data_path.svg
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
csv=$folder/flight.csv
EHM_DEMO_CSV=$csv deploy/demo.sh --seconds 30
gnuplot -e "csv='$csv'; out='deploy/pictures/estimate.svg'" deploy/pictures/estimate.gp
EHM_DEMO_CSV=$csv deploy/demo.sh --mission
gnuplot -e "csv='$csv'; out='deploy/pictures/mission.svg'" deploy/pictures/mission.gp
EHM_DEMO_CSV=$csv deploy/demo.sh --mission --estimator scheduled
gnuplot -e "csv='$csv'; out='deploy/pictures/mission_scheduled.svg'" deploy/pictures/mission.gp
for estimator in tuner gauss_markov time_varying; do
  # time_varying is deaf to the step of health, which the demo's verdict then says
  EHM_DEMO_CSV=$folder/$estimator.csv deploy/demo.sh --seconds 30 --estimator "$estimator" || [ "$estimator" = time_varying ]
done
gnuplot -e "folder='$folder'; out='deploy/pictures/estimators.svg'" deploy/pictures/estimators.gp
"${EHM_BUILD_DIR:-build}/engine_sim/engine_sim" maps --out "$folder" ${1:+--reference "$1"}
cp "$folder/hpc.svg" deploy/pictures/hpc_map.svg
bench=${EHM_BUILD_DIR:-build}/tuner_design/tuner_design
"$bench" linearise --fleet 0 --out "$folder/model.json" --quiet
"$bench" design --model "$folder/model.json" --qh 1e-5 --out "$folder/design.json" --json >"$folder/design.txt"
"$bench" baselines "$folder/design.json" --csv "$folder/baselines.csv" --quiet
limit() { python3 -c 'import json,sys; print(json.load(open(sys.argv[1]))["bayes_limit_"+sys.argv[2]]["total"])' "$folder/design.txt" "$1"; }
gnuplot -e "csv='$folder/baselines.csv'; limit_h=$(limit health); limit_z=$(limit auxiliary); out='deploy/pictures/closed_form.svg'" \
  deploy/pictures/closed_form.gp
"$bench" linearise --method fleet --out "$folder/fleet_model.json" --quiet
"$bench" design --model "$folder/fleet_model.json" --out "$folder/fleet_design.json" --quiet
"$bench" study family --design "$folder/fleet_design.json" --fleet 6 --seed 11 --no-whole-flight --html "$folder/family.html" --quiet
deploy/pictures/svg_of_page.py "$folder/family.html" family-matrix-wide >"$folder/family.svg"
cp "$folder/family.svg" deploy/pictures/family.svg
