#!/usr/bin/env bash
# Builds the package without ROS and a program with it; see --help.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: bash test/without_ros.sh

Builds the libraries and the tool with LSTM_PLANNER_WITH_ROS=OFF and warnings as errors, installs them, moves what was
installed, and uses it there: the tool, the programs of test/consumer, and each public header alone. All in a folder that
is removed afterwards. The packages that it needs are in models/embed.md. Takes 8 minutes on two cores.

Exit status: 0 when everything passed.
USAGE
}

case "${1:-}" in
  '') ;;
  --help | -h) usage; exit 0 ;;
  *) echo "without_ros: unknown argument '$1'; expected --help or nothing." >&2; exit 2 ;;
esac

source_dir="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"
folder="$(mktemp --directory --tmpdir lstm_planner_without_ros.XXXXXX)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cmake -S "$source_dir" -B build -DLSTM_PLANNER_WITH_ROS=OFF -DCMAKE_INSTALL_PREFIX="$folder/installed" \
  -DCMAKE_CXX_FLAGS=-Werror
cmake --build build --parallel "$(nproc)"
cmake --install build >/dev/null
mv installed moved
rm -rf build

moved/bin/lstm_planner model check models/create2_lstm.onnx
moved/bin/lstm_planner drive --worlds mazes --robot create2_hokuyo --goals 3
refusal="$(moved/bin/lstm_planner dataset from-bag none.bag --output none.sqlite 2>&1 || true)"
grep 'built without ROS' <<<"$refusal"
for project in consumer consumer/headers; do
  cmake -S "$source_dir/test/$project" -B "$project" -DCMAKE_PREFIX_PATH="$folder/moved" -DCMAKE_CXX_FLAGS="-Wall -Werror"
  cmake --build "$project" --parallel "$(nproc)"
done
consumer/consumer moved/share/lstm_planner/models/create2_lstm.onnx
