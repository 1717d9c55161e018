#!/usr/bin/env bash
# Measures which lines of the libraries the unit tests run; see --help.
set -uo pipefail
export LSTM_PLANNER_WS="${LSTM_PLANNER_WS:-${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache}/lstm_planner_coverage}"
# shellcheck source-path=SCRIPTDIR source=../launch/environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/environment.sh"

least=90

usage() {
  cat <<USAGE
Usage: bash test/coverage.sh

Builds in a workspace of its own, runs the unit tests and says which share of the lines of the libraries without
ROS, with their public headers, they run: a line a file, and the sum. Pages with each line are in the
workspace, in coverage/index.html.

Environment:
  LSTM_PLANNER_WS       the workspace; default ~/.cache/lstm_planner_coverage
  LSTM_PLANNER_SHARED   data for tests on real maps and recordings; default: shared/ beside the checkout

Exit status: 0 when no test failed and the sum is at least $least %.
USAGE
}

case "${1:-}" in
  '') ;;
  --help | -h) usage; exit 0 ;;
  *) fail "unknown argument '$1'; expected --help or nothing." ;;
esac

# shellcheck disable=SC2034  # read by environment.sh
more_packages=(gcovr)
export CXXFLAGS="${CXXFLAGS:-} --coverage -fprofile-update=atomic"
set_up lstm_planner lstm_planner_unit_tests

export LSTM_PLANNER_SHARED="${LSTM_PLANNER_SHARED:-$source_dir/../shared}"
stay_in_workspace
find "$workspace/build" -name '*.gcda' -delete
log="$workspace/unit_tests.log"
say "running the unit tests, log in $log"
"$workspace/devel/lib/lstm_planner/lstm_planner_unit_tests" </dev/null >"$log" 2>&1
tests_status=$?
grep -E '^\[  FAILED  \]' "$log"

mkdir -p "$workspace/coverage"
gcovr --root "$source_dir" --object-directory "$workspace/build" \
  --filter "$source_dir/(src|include/lstm_planner)/" --exclude "$source_dir/(src|include/lstm_planner)/(ros|tools|compat)/" \
  --exclude-throw-branches --exclude-unreachable-branches -j "$(parallel_jobs)" \
  --txt --html-details "$workspace/coverage/index.html" --fail-under-line "$least" "$workspace/build"
coverage_status=$?
[ "$tests_status" -eq 0 ] && [ "$coverage_status" -eq 0 ]
