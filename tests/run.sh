#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds, and runs the tests through ctest. The last two lines say which tests needed a second
# try, and "N passed, N failed".
# Usage: tests/run.sh                     the default tier: all that guards every change
#        tests/run.sh --full              besides: the control's 1000 demand sequences, and the stages below; one line for
#                                         each at the end, with its time; hours on two cores
#        tests/run.sh --full STAGE...     these stages alone, without the tests of the default tier
# Stages: tidy (tidy.sh), namespaces (the fleet in network namespaces), hostile (the pair under attack), packages (in a
# Debian of their own), demo, tsan and asan (tests under the sanitizers), fuzz.
# EHM_BUILD_DIR names another build folder (default build; the sanitizers' get a suffix). EHM_FUZZ_SECONDS is the time of
# each fuzzer under --full (default 120).
set -euo pipefail
cd "$(dirname "$0")/.."

all_stages=(tidy namespaces hostile packages demo tsan asan fuzz)
full=no wanted=()
case "${1:-}" in
  "") ;;
  --full)
    full=yes
    shift
    for name in "$@"; do
      [[ " ${all_stages[*]} " = *" $name "* ]] ||
        { echo "run.sh: unknown stage '$name'; allowed are ${all_stages[*]}" >&2; exit 2; }
    done
    wanted=("$@")
    ;;
  *) echo "run.sh: unknown option '$1'; allowed is --full [STAGE...]" >&2; exit 2 ;;
esac
build=${EHM_BUILD_DIR:-build}

if [ "$full" = yes ]; then deploy/install-deps.sh --full; else deploy/install-deps.sh; fi

# stage NAME COMMAND...: what fails, or cannot be done here (77), is said at the end and ends nothing else.
stages=() broken=0
stage() {
  local name=$1 began=$SECONDS outcome=passed status=0
  shift
  if [ ${#wanted[@]} -gt 0 ] && [[ " ${wanted[*]} " != *" $name "* ]]; then return; fi
  ( "$@" ) || status=$?
  if [ "$status" -eq 77 ]; then outcome=skipped; elif [ "$status" -ne 0 ]; then outcome=FAILED broken=$((broken + 1)); fi
  stages+=("$(printf '%-12s %-8s %6d s' "$name" "$outcome" $((SECONDS - began)))")
}

# sanitized PRESET TARGETS CTEST_ARGUMENT...: builds with the sanitizers and runs the chosen tests. A report of a
# sanitizer fails the stage even where a second try of the test passes.
sanitized() {
  local name=$1 targets=$2 reports=$build-$1/reports broken=0
  shift 2
  # shellcheck disable=SC2086  # several targets on purpose
  EHM_PRESET=$name deploy/build.sh "$build-$name" $targets || return 1
  rm -rf "$reports" && mkdir -p "$reports" && reports=$(realpath "$reports")/report
  export ASAN_OPTIONS="$ASAN_OPTIONS:log_path=$reports" TSAN_OPTIONS="$TSAN_OPTIONS log_path=$reports"
  export UBSAN_OPTIONS="print_stacktrace=1:log_path=$reports"
  ctest --test-dir "$build-$name" --output-on-failure -j2 -LE integration "$@" || broken=1
  ctest --test-dir "$build-$name" --output-on-failure -j2 -L integration --repeat until-pass:2 "$@" || broken=1
  if compgen -G "$reports.*" >/dev/null; then head -n 60 "$reports".*; broken=1; fi
  return "$broken"
}

if [ "$full" = yes ]; then
  # Fast DDS deletes some objects through a base class of another size (CONTRIBUTING.md).
  export ASAN_OPTIONS=new_delete_type_mismatch=0:detect_leaks=1
  export LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp:print_suppressions=0
  export TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp history_size=7"
  export EHM_CONTROL_SEQUENCES=1000 EHM_BUILD_DIR=$build
fi

EHM_PRESET=release deploy/build.sh "$build"

# run_tests NAME CTEST_ARGUMENT...: ctest shows its output and failures; what it counted is added up for the closing line.
passed=0 failed=0
run_tests() {
  local log=$build/Testing/$1.log said lost all
  shift
  mkdir -p "$build/Testing"
  ctest --test-dir "$build" --output-on-failure -j2 "$@" 2>&1 | tee "$log" || true
  said=$(sed -nE 's/.*tests passed, ([0-9]+) tests failed out of ([0-9]+).*/\1 \2/p' "$log" | tail -1)
  read -r lost all <<< "${said:-1 1}"  # ctest that ends without a count has failed
  passed=$((passed + all - lost)) failed=$((failed + lost))
}
# What computes gives the same each time and has one try. Tests with real processes in real time (label integration) meet
# pauses of a virtual machine that are longer than a lease of 60 ms and have a second one; what is broken fails twice.
if [ ${#wanted[@]} -eq 0 ]; then
  run_tests computed -LE integration
  run_tests integration -L integration --repeat until-pass:2
  # The result of a second try stands without its "number/of all".
  retried=$(sed -nE 's|^ +Test +#[0-9]+: ([^ ]+) .*|\1|p' "$build/Testing/integration.log" | sort -u)
  echo "second tries: $(grep -c . <<< "$retried" || true)" $retried
else
  run_tests design -R '^integration\.(linearise|design)$'  # that namespaces flies
fi

if [ "$full" = yes ]; then
  unset EHM_CONTROL_SEQUENCES
  stage tidy tests/tidy.sh "$build"
  stage namespaces tests/fleet/namespaces.sh "$build" "$build/tests/integration/design.json"
  stage hostile tests/hostile.sh "$build"
  stage packages tests/packages/packages.sh "$build"
  stage demo deploy/demo.sh --seconds 30
  stage tsan sanitized tsan "integration_test lifecycle_test monitor_service_test engine_sim monitor ehm_watch tuner_design" \
    -R 'SpscQueue|FlightTest|BadSamplesTest|ReloadTest|CheckpointTest'
  # One build with clang for the tests and the fuzzers. Left out is what the sanitizer itself changes: it allocates, locks
  # no memory, keeps what is freed for a while (the soak's growth), takes its time (the benches), and its libraries link
  # with no other compiler.
  stage asan sanitized asan all \
    -E '^Allocation|^RealtimeTest\.(MemoryIsLocked|WithoutThePrivilege)|^integration\.package$|^soak\.minute$|^bench\.'
  stage fuzz tests/fuzz/fuzz.sh --jobs 2 --seconds "${EHM_FUZZ_SECONDS:-120}"
  printf '%s\n' "${stages[@]}"
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$broken" -eq 0 ]
