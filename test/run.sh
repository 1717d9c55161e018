#!/usr/bin/env bash
# Sets everything up and runs the tests; see --help.
set -uo pipefail
# shellcheck source-path=SCRIPTDIR source=../launch/environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/environment.sh"

# shellcheck disable=SC2034  # read by environment.sh
more_optional_packages=(catkin-lint clang-format doxygen shellcheck)  # for test/lint.sh
wants_rviz=true  # its panel is tested without a display

usage() {
  cat <<'USAGE'
Usage: bash test/run.sh [--build-only] [FILTER]

Installs what is missing, builds the package and its tests in a workspace outside the source tree, and runs them: the
unit tests in as many processes as there are processors, then the rostests, twice as many at a time, each under a ROS
master of its own; without FILTER also the linters (test/lint.sh). The last line counts the test cases. A test that is skipped
counts as a failure, unless test/skips.txt allows it. HOME and TMPDIR of the tests are folders in the workspace, and what a
test leaves in its HOME is a failure.

Arguments:
  FILTER         an extended regular expression on names: unit tests are Suite.Case, rostests are files in test/ros
  --build-only   install and build, do not run
  --help         this text

Environment:
  LSTM_PLANNER_WS       the workspace; default ~/.cache/lstm_planner
  LSTM_PLANNER_SHARED   data for tests on real maps and recordings; default: shared/ beside the checkout
  CXXFLAGS              more options for the compiler, for every package in the workspace, e.g. -Werror

Exit status: 0 when no test failed.
USAGE
}

# Fails when the tests left something in their home: without this script, that is the user's.
check_home() {
  local left
  left="$(find "$HOME" -mindepth 1 -not -type d)"
  [ -z "$left" ] || echo "FAILED home: the tests left ${left//$'\n'/, }" >&2
  [ -z "$left" ]
}

unit_test_processes=()

# Starts the unit tests that gtest's filter ($1) selects, in one process a processor. Rostests have priority: they mostly
# wait, and some of them wait by the computer's clock.
start_unit_tests() {
  local shards shard
  shards="$(parallel_jobs)"
  for ((shard = 0; shard < shards; ++shard)); do
    GTEST_FILTER="$1" GTEST_TOTAL_SHARDS="$shards" GTEST_SHARD_INDEX="$shard" \
      GTEST_OUTPUT="xml:$results/gtest-unit_tests_$shard.xml" \
      nice -n 19 "$workspace/devel/lib/lstm_planner/lstm_planner_unit_tests" </dev/null >"$results/unit_tests_$shard.log" 2>&1 &
    unit_test_processes+=($!)
  done
}

# Waits for them, and shows what the failing ones printed. Leaves their exit statuses beside their results: a process
# that crashes has no results, or passed ones only.
finish_unit_tests() {
  local shard ended status=0
  for shard in "${!unit_test_processes[@]}"; do
    ended=0
    wait "${unit_test_processes[shard]}" || ended=$?
    echo "$ended" >"$results/unit_tests_$shard.status"
    if [ "$ended" -ne 0 ]; then
      status=1
      cat "$results/unit_tests_$shard.log"
    fi
  done
  return "$status"
}

# Names of the unit tests, Suite.Case, one a line.
list_unit_tests() {
  "$workspace/devel/lib/lstm_planner/lstm_planner_unit_tests" --gtest_list_tests |
    awk '{sub(/ *#.*/, "")} /^[^ ].*\.$/ {suite = $1; next} /^  / {print suite $1}'
}

# Runs what the filter ($1, may be empty) selects; leaves the results in $results. Fails when something failed.
run_tests() {
  local filter="$1" unit_tests ros_tests status=0
  unit_tests="$(list_unit_tests | grep -E -- "$filter" | paste -sd:)"
  ros_tests="$(find "$source_dir/test/ros" -name '*.test' -printf '%P\n' 2>/dev/null | tr / _ |
    grep -E -- "$filter" | sed 's/\.test$//' | sort | paste -sd'|')"
  [ -n "$unit_tests$ros_tests" ] || fail "no test matches '$filter'."

  mkdir -p "$results"
  if [ -n "$unit_tests" ]; then
    if [ -z "$filter" ]; then unit_tests='*'; fi
    start_unit_tests "$unit_tests"
  fi
  if [ -n "$ros_tests" ]; then
    cd "$workspace/build" || exit 1
    # Two a processor: they mostly wait for clocks and for processes to start.
    ctest --output-on-failure --parallel "$((2 * $(parallel_jobs)))" -R "_rostest_test_ros_($ros_tests)\.test\$" </dev/null ||
      status=1
  fi
  finish_unit_tests || status=1
  return "$status"
}

build_only=false
filter=
for argument in "$@"; do
  case "$argument" in
    --help | -h) usage; exit 0 ;;
    --build-only) build_only=true ;;
    -*) fail "unknown option '$argument'; expected --build-only or --help." ;;
    *) [ -z "$filter" ] || fail "one filter at most, got '$filter' and '$argument'."; filter="$argument" ;;
  esac
done

echo | grep -qE -- "$filter" 2>/dev/null
[ $? -le 1 ] || fail "'$filter' is not an extended regular expression."

set_up all tests
if [ "$build_only" = true ]; then exit 0; fi

export LSTM_PLANNER_SHARED="${LSTM_PLANNER_SHARED:-$source_dir/../shared}"
stay_in_workspace
results="$workspace/build/test_results/lstm_planner"
rm -rf "$results"
status=0
if [ -z "$filter" ]; then bash "$source_dir/test/lint.sh" || status=1; fi
run_tests "$filter" || status=1
check_home || status=1
/usr/bin/python3 "$source_dir/test/count_results.py" "$results" "$source_dir/test/skips.txt" || status=1
exit "$status"
