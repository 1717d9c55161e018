#!/bin/bash
# Measures a network in most of the drives that the tables of README.md, models/README.md and the network's card show:
#
#   bash models/measure.sh MODEL BARN MAPS FOLDER
#
# MODEL is the ONNX file, BARN the file barn_cylinders.csv, MAPS the folder of the eight buildings. What each command prints is
# in FOLDER/NAME.txt, with NAME.json beside it; what is there is not measured again. Needs lstm_planner on the path; an hour on
# two cores.
set -euo pipefail

if [[ $# -ne 4 ]]; then
  sed -n '2,8s/^# \{0,1\}//p' "$0"
  exit 2
fi
model="$(realpath "$1")"
barn="$(realpath "$2")"
maps="$(realpath "$3")"
mkdir -p "$4"
pairs="$(realpath "$(dirname "$0")")/paired_paths.py"
cd "$4"

kinds=(mazes offices corridors rooms forest open)
buildings=()
for map in home_small brsu-c069 dis-B1-2011-09-27 zaki_2018may9_before building_31 stata_basement etsidi_slam_real1; do
  buildings+=("$maps/$map.yaml")
done
buildings+=("$maps/stage_ros_willow-full.yaml=0.19") # its grey is free at that threshold

# measure NAME COMMAND...
measure() {
  local name="$1"
  shift
  [[ -e "$name.txt" ]] && return
  echo "$name: $*"
  "$@" >"$name.part"
  mv "$name.part" "$name.txt"
}

# drive NAME OPTION...
drive() {
  measure "$1" lstm_planner drive --model "$model" --drift 0.02 --json "$1.json" "${@:2}"
}

measure pairs_drift python3 "$pairs" --model "$model" --drift 0.02
measure pairs python3 "$pairs" --model "$model"
measure pairs_buildings python3 "$pairs" --model "$model" --drift 0.02 --kinds --maps "${buildings[@]}"
measure pairs_buildings_no_drift python3 "$pairs" --model "$model" --kinds --maps "${buildings[@]}"
measure judge lstm_planner judge --model "$model" --worlds 180 --seed 11 --kinds mazes offices corridors forest open rooms

for kind in "${kinds[@]}"; do
  drive "$kind" --worlds "$kind"
  drive "alone_$kind" --worlds "$kind" --no-escape --no-memory
done
for map in "${buildings[@]}"; do
  drive "alone_$(basename "${map%.yaml*}")" --map "$map" --goals 50 --no-escape --no-memory
done
drive barn --barn "$barn"
drive alone_barn --barn "$barn" --no-escape --no-memory
drive alone_barn_long --barn "$barn" --no-escape --no-memory --time-limit 1800
drive jackal_barn --barn "$barn" --robot jackal
drive no_memory --worlds offices --goals 40 --no-memory --time-limit 600

drive people --walkers 10
drive people_jackal --walkers 10 --robot jackal
drive people_jackal_evade --walkers 10 --robot jackal --evade 2.5
for seed in 1 2 3 4 5; do
  drive "people_$seed" --walkers 10 --goals 100 --seed "$seed"
done
for seed in {1..10}; do
  drive "cylinders_$seed" --worlds dynabarn --robot jackal --evade 2.5 --seed "$seed"
done
for seed in 1 2 3; do
  drive "cylinders_waiting_$seed" --worlds dynabarn --robot jackal --evade 0 --seed "$seed"
done
for robot in create2_hokuyo create2_rplidar turtlebot3_burger turtlebot3_waffle jackal; do
  for leader in network route; do
    for kind in offices mazes rooms; do
      drive "${robot}_${leader}_$kind" --robot "$robot" --leader "$leader" --worlds "$kind" --goals 50
    done
    drive "${robot}_${leader}_barn" --robot "$robot" --leader "$leader" --barn "$barn"
  done
done
