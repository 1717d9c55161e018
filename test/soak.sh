#!/usr/bin/env bash
# A simulated day, or 10,000 drives; see --help.
set -uo pipefail
# shellcheck source-path=SCRIPTDIR source=../launch/environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/environment.sh"

usage() {
  cat <<'USAGE'
Usage: bash test/soak.sh day|drives [--hours H] [--goals N] [--seed N] [--build-only]

  day     test/ros/soak.cpp: both plugins and the recorder drive the simulated robot to random goals in worlds of all
          kinds, while its sensors, transforms and clock fail now and then. Prints a line for each hour. Fails when
          something was touched, when memory, threads, descriptors or the time for a plan have grown from the second
          quarter of the time to the last, or when a dataset has a fault.
  drives  lstm_planner drive in worlds of all kinds, one drive in each. Fails when something was touched.

Options:
  --hours H     day: simulated time, a whole number; default 24
  --goals N     drives: worlds of each of the six kinds; default 1667
  --seed N      of everything that is random; default 1
  --build-only  install and build, do not run
  --help        this text

Environment:
  LSTM_PLANNER_WS  the workspace; default ~/.cache/lstm_planner

Exit status: 0 when nothing was found.
USAGE
}

soak() {
  local log="$workspace/soak.log"
  say "$hours hours, log in $log"
  rostest --text lstm_planner soak.test "hours:=$hours" "seed:=$seed" "time_limit:=$((600 + 600 * hours))" \
    </dev/null 2>&1 | tee "$log" | grep --line-buffered -a '^|'
  # A node's own status is unknown to rostest --text.
  if grep -aq 'Failure$' "$log" || ! grep -aq '\[  PASSED  \] 1 test' "$log"; then
    grep -a -A 5 'Failure$' "$log" >&2
    fail "something was found, see $log"
  fi
  say "nothing was found"
}

drive() {
  local kind result="$workspace/drives" touched=0
  mkdir -p "$result"
  for kind in mazes offices corridors forest open rooms; do
    "$workspace/devel/bin/lstm_planner" drive --model "$source_dir/models/create2_lstm.onnx" --worlds "$kind" \
      --goals "$goals" --drift 0.02 --seed "$seed" --json "$result/$kind.json" --details "$result/$kind.csv" \
      >"$result/$kind.log" 2>&1 || fail "the drives in $kind ended with an error: $(tail -n 1 "$result/$kind.log")"
    /usr/bin/python3 - "$result/$kind.json" <<'SUMMARY' || touched=1
import json, sys
result = json.load(open(sys.argv[1]))
print('{map}: {goals} drives, {reached} reached, {contacts} contacts'.format(**result), flush=True)
sys.exit(result['contacts'] > 0)
SUMMARY
  done
  [ "$touched" -eq 0 ] || fail "something was touched, see the column contacts in $result/*.csv"
  say "nothing was touched"
}

what="${1:-}"
case "$what" in
  day) targets=(ros_tests) ;;
  drives) targets=(lstm_planner) ;;
  --help | -h) usage; exit 0 ;;
  *) fail "'$what' is nothing that can be run, expected day or drives; see --help." ;;
esac
shift
build_only=false
hours=24
goals=1667
seed=1
while [ "$#" -gt 0 ]; do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --build-only) build_only=true ;;
    --hours | --goals | --seed)
      [[ "${2:-}" =~ ^[1-9][0-9]{0,8}$ ]] || fail "$1 is '${2:-}', expected a whole number above 0."
      declare "${1#--}=$2"
      shift ;;
    *) fail "unknown option '$1'; expected --hours, --goals, --seed, --build-only or --help." ;;
  esac
  shift
done

set_up "${targets[@]}"
if [ "$build_only" = true ]; then exit 0; fi
stay_in_workspace
if [ "$what" = day ]; then soak; else drive; fi
