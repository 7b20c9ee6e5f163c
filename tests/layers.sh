#!/usr/bin/env bash
# Dependencies point one way (deploy/docs/architecture.md, "The house"): greps the includes of each layer for what it must not know.
set -uo pipefail
cd "$(dirname "$0")/.."
failures=0

# forbid WHY PATTERN PATH...: no file below the paths includes what matches the pattern.
forbid() {
  local why=$1 pattern=$2
  shift 2
  local found
  for path in "$@"; do [ -e "$path" ] || { echo "layers: $path does not exist"; failures=$((failures + 1)); }; done
  found=$(grep -rnP --include='*.h' --include='*.cpp' "#include [<\"]($pattern)" "$@")
  if [ -n "$found" ]; then
    echo "layers: $why"
    echo "$found"
    failures=$((failures + 1))
  fi
}

dds='fastdds|fastrtps|engine_health|idl/dds|idl/topics|idl/layout'
outside="$dds|spdlog|chrono|thread|mutex|fstream|iostream|cstdio|time\.h|filesystem"
pure=(engine_sim/model engine_sim/control engine_sim/sensors monitor/estimation monitor/checks monitor/judge
  monitor/cycle/monitor_cycle.h monitor/cycle/monitor_cycle.cpp monitor/cycle/cycle_faults.cpp deploy/runtime/units)

forbid "physics and estimation know no DDS, clock, thread, log or file" "$outside" "${pure[@]}"
mapfile -t truth < <(find engine_sim -mindepth 1 -maxdepth 1 ! -name linear)
forbid "the truth does not know the estimator" 'monitor/|tuner_design/' "${truth[@]}"
forbid "a user's own model is flown from its file, and nothing else of the monitor is known" \
  'monitor/(?!design/model_file\.h|estimation/(discretise|linear_model|sensor_noise|stationary_covariance)\.h)|tuner_design/' engine_sim/linear
forbid "an engine stands on the model, its control's data and the files" \
  'engine_sim/(sensors|scenario|dds|linear|linear_model|simulation|deck|figures)|deploy/runtime/(?!files)|idl/' engine_sim/engines
forbid "the model knows nothing but itself" 'engine_sim/(control|sensors|scenario|dds)|deploy/|idl/' engine_sim/model
forbid "estimation stands below everything" 'monitor/(checks|judge|dds|design|monitor_cycle|realtime)|engine_sim|tuner_design|idl/' monitor/estimation
forbid "the monitor flies without the bench and without the simulator" 'tuner_design/|engine_sim/(control|sensors|scenario|dds|simulation)' monitor
forbid "the bench is offline: no DDS" "$dds" tuner_design monitor/design
forbid "the offline commands need no DDS" "$dds" engine_sim/deck engine_sim/figures engine_sim/engine_command engine_sim/commands.h engine_sim/commands.cpp
forbid "files know no program" 'engine_sim/|monitor/|tuner_design/' deploy/runtime/files deploy/runtime/recording deploy/runtime/units
forbid "recordings know no DDS" "$dds" deploy/runtime/recording
forbid "operators' tools know no service, only the wire" 'engine_sim/|monitor/|tuner_design/' deploy/client deploy/command
forbid "the wire knows no service" 'engine_sim/|monitor/|tuner_design/' idl
forbid "nothing includes the tests" 'tests/' engine_sim monitor tuner_design idl deploy

[ "$failures" -eq 0 ] && echo "layers: every include points the right way"
exit "$failures"
