#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# One command from a bare Debian 12 to live estimates: installs, builds, designs, flies.
# Usage: deploy/demo.sh [--mission | --seconds N] [--estimator NAME] [--json]
#   --mission     a whole flight from taxi to taxi in 72 s, and its summary at landing
#   --seconds N   length of the flight, 12 to 86400 (default 30); at 10 s HPC efficiency falls by 2 %
#   --estimator NAME   whose estimates are published: tuner (default), gauss_markov, time_varying, map, rls, constrained,
#                 ekf, iekf, clipped_ekf, ukf, or for comparison wls, particle, ekpf, cekpf; with --mission onboard
#                 (default), or scheduled, which is deaf to a step of health and has none in its flight
#   --json        print the summary as one JSON object and nothing else on standard output
# Exit: 0 nothing lost or withheld and every estimate within 3 published sigmas, 1 otherwise, 2 wrong usage
# EHM_BUILD_DIR names another build folder, EHM_DDS_DOMAIN another DDS domain (default 42), EHM_DEMO_CSV a file for every
# estimate beside its truth.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=30
estimator=
json=()
mission=false
usage() { sed -n '2,14s/^# //p' deploy/demo.sh; }
while [ $# -gt 0 ]; do
  case "$1" in
    --seconds)
      seconds=${2:-}
      if ! [[ $seconds =~ ^[0-9]+$ ]] || [ "$seconds" -lt 12 ] || [ "$seconds" -gt 86400 ]; then
        echo "demo: --seconds is '${2:-}', allowed is a whole number from 12 to 86400" >&2
        exit 2
      fi
      shift 2 ;;
    --estimator)
      estimator=${2:-nothing}
      shift; [ $# -eq 0 ] || shift ;;
    --mission) mission=true; shift ;;
    --json) json=(--json); shift ;;
    -h | --help) usage; exit 0 ;;
    *) echo "demo: unknown option '$1'" >&2; usage >&2; exit 2 ;;
  esac
done

if "$mission"; then names='onboard scheduled'; else names='tuner gauss_markov time_varying map wls rls constrained ekf iekf clipped_ekf ukf particle ekpf cekpf'; fi
estimator=${estimator:-${names%% *}}
if [[ " $names " != *" $estimator "* ]]; then
  echo "demo: --estimator is '$estimator', allowed is one of ${names// /, }" >&2
  exit 2
fi
if "$mission"; then
  if [ "$seconds" != 30 ]; then
    echo "demo: --mission has a length of its own: leave out --seconds" >&2
    exit 2
  fi
  seconds=1800
fi

build=${EHM_BUILD_DIR:-build}
domain=${EHM_DDS_DOMAIN:-42}
{
  deploy/install-deps.sh
  EHM_PRESET=release deploy/build.sh "$build" engine_sim monitor tuner_design ehm_watch  # as the tests: compiled once
} >&2

work=$(mktemp -d "${TMPDIR:-/tmp}/ehm-demo.XXXXXX")
children=()
clean_up() {
  trap - EXIT INT TERM
  for child in "${children[@]}"; do kill -TERM "$child" 2>/dev/null || true; done
  for child in "${children[@]}"; do wait "$child" 2>/dev/null || true; done
  rm -rf "$work"
}
trap clean_up EXIT
trap 'exit 130' INT TERM

if [ "$estimator" = scheduled ]; then
  "$build/tuner_design/tuner_design" envelope --out "$work/design.json" >&2
else
  "$build/tuner_design/tuner_design" linearise --method fleet --out "$work/model.json" >&2
  "$build/tuner_design/tuner_design" design --model "$work/model.json" --out "$work/design.json" >&2
fi

# Should this script die without a chance to clean up, the kernel stops the services.
start() {
  local name=$1
  shift
  setpriv --pdeathsig TERM -- "$@" 2>"$work/$name.log" &
  children+=($!)
}
flight=(--config deploy/demo/engine_sim.toml --run-duration-s "$seconds")
more=(--config deploy/demo/monitor.toml)
case "$estimator" in
  *ekf | ukf | particle | *ekpf)  # their engine has the sensors of the demo's, which do not lag, and health that may step
    more+=(--estimator-lag-speed-s 0 --estimator-lag-pressure-s 0 --estimator-lag-temperature-s 0
           --estimator-health-walk-percent 0.003) ;;
  rls) more+=(--estimator-memory-s 2) ;;  # as the tuner filter, to follow a step
  constrained) more+=(--estimator-constrained-of gauss_markov) ;;  # what follows a step
esac
if "$mission"; then
  mkdir "$work/history"
  cp deploy/demo/mission.toml "$work/mission.toml"
  [ "$estimator" = onboard ] || sed -i '/^\[\[health_change\]\]/,$d' "$work/mission.toml"
  flight=(--config "$work/mission.toml" --run-rate 25)
  more=(--history-directory "$work/history" --monitor-clock source)  # its time runs 25 times as fast as ours
fi
start monitor "$build/monitor/monitor" "${more[@]}" --monitor-design "$work/design.json" \
  --estimator-published "$estimator" --dds-domain "$domain"
start engine_sim "$build/engine_sim/engine_sim" "${flight[@]}" --dds-domain "$domain" --run-wait-for-monitors 1

verdict=0
setpriv --pdeathsig TERM -- "$build/deploy/ehm_watch" --domain "$domain" --seconds "$seconds" "${json[@]}" \
  ${EHM_DEMO_CSV:+--csv "$EHM_DEMO_CSV"} &
children+=($!)
wait "${children[2]}" || verdict=$?
if [ "$verdict" -ne 0 ]; then
  for log in "$work"/*.log; do echo "--- $(basename "$log")"; tail -n 20 "$log"; done >&2
fi
if "$mission" && [ ${#json[@]} -eq 0 ]; then
  echo
  "$build/monitor/monitor" history 1 --directory "$work/history" --flight 1 || verdict=1
fi
exit "$verdict"
