#!/usr/bin/env bash
# Builds everything with sanitizers and runs tests with them; see --help.
set -uo pipefail
kind="${1:-}"
LSTM_PLANNER_WS="${LSTM_PLANNER_WS:-${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache}/lstm_planner_$kind}"
# shellcheck source-path=SCRIPTDIR source=../launch/environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/environment.sh"

usage() {
  cat <<'USAGE'
Usage: bash test/sanitize.sh address|thread [--build-only] [--repetitions N]

Builds the package with sanitizers in a workspace of its own, and runs tests that end at the first thing they find.

  address         addresses, leaks, undefined behaviour and float to integer: the unit tests, and the rostests of the
                  plugins
  thread          data races: the plugins asked in one thread while messages arrive in others, loaded and unloaded
                  meanwhile, and two of a kind (test/ros/plugin_threads.cpp)

Options:
  --repetitions N  how often the plugins are loaded and unloaded; default 1000
  --build-only     install and build, do not run
  --help           this text

Environment:
  LSTM_PLANNER_WS       the workspace; default ~/.cache/lstm_planner_address or _thread
  LSTM_PLANNER_SHARED   data for tests on real maps and recordings; default: shared/ beside the checkout

Exit status: 0 when nothing was found.
USAGE
}

findings='ERROR: (Address|Leak)Sanitizer|WARNING: ThreadSanitizer|runtime error: |FAILURE|\[  FAILED'

# Ends a test that left $1 as its log with the status $2; a node's own status is unknown to rostest.
judge() {
  grep -aE "$findings" "$1" >&2 && return 1
  return "$2"
}

plugin_tests=(bad_sensors controller_plugin planner_plugin planner_steps plugin_threads)

# Runs rostest test/ros/$1.test with the arguments behind it.
run_rostest() {
  local log="$workspace/$1.log"
  say "$1, log in $log"
  rostest --text lstm_planner "$1.test" "${@:2}" </dev/null >"$log" 2>&1
  judge "$log" $?
}

run_unit_tests() {
  local log="$workspace/unit_tests.log"
  say "unit_tests, log in $log"
  "$workspace/devel/lib/lstm_planner/lstm_planner_unit_tests" </dev/null >"$log" 2>&1
  judge "$log" $?
}

case "$kind" in
  address)
    tests=("${plugin_tests[@]}") targets=(lstm_planner_unit_tests ros_tests) sanitizers=address,undefined,float-cast-overflow ;;
  thread) tests=(plugin_threads) targets=(ros_tests) sanitizers=thread ;;
  --help | -h) usage; exit 0 ;;
  *) fail "'$kind' is no kind of sanitizer, expected address or thread; see --help." ;;
esac
shift
build_only=false
repetitions=1000
while [ "$#" -gt 0 ]; do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --build-only) build_only=true ;;
    --repetitions)
      [[ "${2:-}" =~ ^[1-9][0-9]*$ ]] || fail "$1 is '${2:-}', expected a whole number above 0."
      repetitions="$2"
      shift ;;
    *) fail "unknown option '$1'; expected --repetitions, --build-only or --help." ;;
  esac
  shift
done

set_up "-DLSTM_PLANNER_SANITIZERS=$sanitizers" lstm_planner_plugins "${targets[@]}"
if [ "$build_only" = true ]; then exit 0; fi

export LSTM_PLANNER_SHARED="${LSTM_PLANNER_SHARED:-$source_dir/../shared}"
stay_in_workspace
export ASAN_OPTIONS="detect_stack_use_after_return=1:${ASAN_OPTIONS:-}"
export LSAN_OPTIONS="suppressions=$source_dir/test/sanitize/leaks.supp:print_suppressions=0:${LSAN_OPTIONS:-}"
export UBSAN_OPTIONS="print_stacktrace=1:${UBSAN_OPTIONS:-}"
export TSAN_OPTIONS="suppressions=$source_dir/test/sanitize/threads.supp:second_deadlock_stack=1:${TSAN_OPTIONS:-}"

failed=()
if [ "$kind" = address ]; then
  run_unit_tests || failed+=(unit_tests)
fi
for test in "${tests[@]}"; do
  arguments=()
  if [ "$test" = plugin_threads ]; then arguments=("repetitions:=$repetitions"); fi
  run_rostest "$test" "${arguments[@]}" || failed+=("$test")
done
[ "${#failed[@]}" -eq 0 ] || fail "found something in: ${failed[*]}"
say "nothing was found"
