#!/usr/bin/env bash
# Makes the pictures of rviz in launch/ again, without a screen; see --help.
set -uo pipefail

usage() {
  cat <<'USAGE'
Usage: bash test/pictures.sh [NAME...]

Makes launch/NAME.png again; NAME is rviz, panel, record_dataset, advice or replay; without NAME all of them. Needs a sourced workspace in
which the package is built, and the programs rviz, Xvfb and scrot. Look at the pictures before you commit them.

Exit status: 0 when all were made.
USAGE
}

fail() {
  echo "pictures: $*" >&2
  exit 1
}

case "${1:-}" in
  --help | -h) usage; exit 0 ;;
esac
for program in Xvfb rviz roslaunch rosrun scrot; do
  command -v "$program" >/dev/null || fail "$program is not installed"
done

folder="$(cd "$(dirname "${BASH_SOURCE[0]}")/../launch" && pwd -P)"
scratch="$(mktemp -d)"
processes=()
finish() {
  local process
  for process in "${processes[@]}"; do kill -INT "$process" 2>/dev/null; done
  wait
  rm -rf "$scratch"
}
trap finish EXIT

# Starts a screen, and takes its number for DISPLAY.
start_screen() {
  local number
  Xvfb -displayfd 3 -screen 0 1280x900x24 3>"$scratch/display" >/dev/null 2>&1 &
  processes+=($!)
  until number="$(cat "$scratch/display" 2>/dev/null)" && [ -n "$number" ]; do
    kill -0 $! 2>/dev/null || fail "Xvfb does not start"
  done
  export DISPLAY=":$number" LIBGL_ALWAYS_SOFTWARE=1
}

# launch/$1.png is the part $2 (x,y,width,height) of the screen $3 seconds after `roslaunch lstm_planner` with the rest.
take() {
  local name="$1" part="$2" seconds="$3" launch
  shift 3
  roslaunch lstm_planner "$@" </dev/null >"$scratch/$name.log" 2>&1 &
  launch=$!
  processes+=("$launch")
  sleep "$seconds"
  kill -0 "$launch" 2>/dev/null || fail "roslaunch lstm_planner $* has ended: $(tail -n 3 "$scratch/$name.log")"
  scrot --overwrite --autoselect "$part" "$folder/$name.png" || fail "scrot could not make $folder/$name.png"
  kill -INT "$launch"
  wait "$launch"
  echo "$folder/$name.png"
}

config="$(rospack find lstm_planner)/config" || fail "the package is not in the environment: source the workspace's setup.bash"
whole=0,0,1280,900
make_picture() {
  case "$1" in
    rviz) take rviz "$whole" 22 demo.launch leader:=network real_time_factor:=1 picture:=none rviz:=true ;;
    panel) take panel 0,430,380,402 22 demo.launch leader:=network real_time_factor:=1 picture:=none rviz:=true ;;
    record_dataset)
      take record_dataset "$whole" 25 record_dataset.launch teleop:=scripted "output:=$scratch/drives.sqlite" \
        "map:=$config/demo_building.yaml" "waypoints:=$config/demo_waypoints.yaml" rviz:=true ;;
    advice)
      take advice 366,62,898,808 40 advice.launch teleop:=scripted "map:=$config/demo_building.yaml" \
        "waypoints:=[[6.5, 1.25], [2.0, 8.25]]" rviz:=true ;;
    replay) take replay "$whole" 45 replay.launch "bag:=$folder/../test/bags/dead_end.bag" rviz:=true ;;
    *) fail "there is no picture '$1'; expected rviz, panel, record_dataset, advice or replay" ;;
  esac
}

[ "$#" -gt 0 ] || set -- rviz panel record_dataset advice replay
start_screen
for name in "$@"; do make_picture "$name"; done
