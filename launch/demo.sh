#!/usr/bin/env bash
# Sets everything up and drives the simulated Create 2 through a building; see --help.
set -uo pipefail
# shellcheck source-path=SCRIPTDIR source=environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

usage() {
  cat <<'USAGE'
Usage: bash launch/demo.sh [--build-only] [NAME:=VALUE ...]

Installs what is missing, builds the package in a workspace outside the source tree, and drives the simulated Create 2
to a list of goals in a building, with both plugins in move_base. Prints a line for each goal and a summary, and draws
the map with the driven path. Opens rviz if there is a display.

Options:
  --build-only   install and build, do not drive
  --help         this text

Arguments of launch/demo.launch, among them:
  map:=FILE      a map as map_server reads it (yaml); default: the building that comes with the package
  goals:=FILE    the goals to drive to, in the map's frame
  picture:=FILE  where to draw the picture, or none; default: ~/lstm_planner_demo.png
  leader:=NAME   who leads: network (the default), or route
  All of them:   roslaunch lstm_planner demo.launch --ros-args

Environment:
  LSTM_PLANNER_WS   the workspace; default ~/.cache/lstm_planner

Exit status: 0 if every goal was reached and nothing was touched.
USAGE
}

# roslaunch always ends with 0, so the demo runner writes its exit status to a file.
drive() {
  local result status
  result="$(mktemp "${TMPDIR:-/tmp}/lstm_planner_demo.XXXXXX")"
  # shellcheck disable=SC2064  # the name is known now
  trap "rm -f '$result'" EXIT
  PYTHONUNBUFFERED=1 roslaunch lstm_planner demo.launch "result:=$result" "$@" </dev/null
  status="$(head -n 1 "$result" | grep -oE '^[0-9]+$')" || fail "the demo ended before it had a result."
  # roslaunch's last lines name processes that ended, also after success.
  [ "$status" -eq 0 ] || fail "the demo did not succeed; the lines 'demo:' and errors above say why."
  say "every goal was reached and nothing was touched"
  say "to use the package in this shell: source $workspace/devel/setup.bash"
}

# A master of another robot on the usual port must not be joined.
choose_master() {
  local port
  port="$(/usr/bin/python3 - <<'PYTHON'
import socket

def is_free(port):
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("", port))
        except OSError:
            return False
        return True

print(next((port for port in range(11311, 11411) if is_free(port)), 11311))
PYTHON
)"
  export ROS_MASTER_URI="http://localhost:$port"
  [ "$port" = 11311 ] || say "a ROS master runs here already; this demo's is $ROS_MASTER_URI"
}

# An argument NAME:=VALUE for demo.launch: roslaunch takes any name, and its nodes do not run in this folder.
checked_argument() {
  local name="${1%%:=*}" value="${1#*:=}"
  grep -qF "<arg name=\"$name\" default" "$source_dir/launch/demo.launch" ||
    fail "demo.launch has no argument '$name'; expected one of those that --help names."
  # roslaunch ignores an argument without a value.
  [ -n "$value" ] || fail "the argument $name:= has no value."
  case "$name" in
    map | goals | model | picture)
      case "$value" in default | none | /* | *://*) ;; *) value="$PWD/$value" ;; esac ;;
  esac
  echo "$name:=$value"
}

build_only=false
arguments=()
for argument in "$@"; do
  case "$argument" in
    --help | -h) usage; exit 0 ;;
    --build-only) build_only=true ;;
    *:=*) argument="$(checked_argument "$argument")" || exit 1; arguments+=("$argument") ;;
    *) fail "unknown argument '$argument'; expected --build-only, --help or NAME:=VALUE." ;;
  esac
done

set_up lstm_planner_demo
if [ "$build_only" = true ]; then exit 0; fi
choose_master
drive "${arguments[@]}"
