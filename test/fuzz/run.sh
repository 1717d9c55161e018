#!/usr/bin/env bash
# Builds the fuzzers and runs them; see --help.
set -uo pipefail
LSTM_PLANNER_WS="${LSTM_PLANNER_WS:-${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache}/lstm_planner_fuzz}"
# shellcheck source-path=SCRIPTDIR source=../../launch/environment.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../launch/environment.sh"

default_runs=1000000

usage() {
  cat <<USAGE
Usage: bash test/fuzz/run.sh [HARNESS ...] [--runs N] [--seconds N] [--build-only]

Builds the fuzzers with clang, libFuzzer and its sanitizers (address, undefined behaviour, float to integer) in a
workspace of its own, and runs them one after the other. What they find stays in the workspace, in fuzz/HARNESS: inputs
that reach something new, and as crash-*, oom-*, slow-unit-* and timeout-* those that fail. A mended failure's input goes
into test/fuzz/corpus/HARNESS, which the unit tests run.

Arguments:
  HARNESS        files of test/fuzz/harnesses without .cpp; default: all
  --runs N       executions of each; default $default_runs
  --seconds N    at most this long for each; default: no limit
  --build-only   install and build, do not run
  --help         this text

Environment:
  LSTM_PLANNER_WS   the workspace; default ~/.cache/lstm_planner_fuzz

Exit status: 0 when nothing failed.
USAGE
}

harness_names() { basename -s .cpp "$source_dir"/test/fuzz/harnesses/*.cpp; }

# The longest input, in bytes. Messages that follow one another: 512 bytes hold every kind of them, and run four times as fast.
longest_input() {
  case "$1" in
    bag | recorder) echo 512 ;;
    *) echo 2048 ;;
  esac
}

# Runs one fuzzer ($1) within the limits that hold for every input: 10 s, 1 GB, 512 MB at once.
run_fuzzer() {
  local name="$1" found="$workspace/fuzz/$1"
  # Traces of where memory was taken cost a tenth of the time, much memory that waits to be used again a quarter, and
  # weighing inputs by their entropy up to half of it; run a failure's input again without these options.
  local -x ASAN_OPTIONS="malloc_context_size=1:quarantine_size_mb=1:thread_local_quarantine_size_kb=64:${ASAN_OPTIONS:-}"
  mkdir -p "$found"
  say "$name: $runs executions at most, log in $found.log"
  "$workspace/devel/lib/lstm_planner/fuzz_$name" -runs="$runs" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1024 \
    -malloc_limit_mb=512 -entropic=0 -max_len="$(longest_input "$name")" -print_final_stats=1 -artifact_prefix="$found/" "$found" \
    "$source_dir/test/fuzz/corpus/$name" </dev/null >"$found.log" 2>&1 && return
  grep -E 'ERROR|runtime error|what\(\)|Test unit written' "$found.log" >&2
  return 1
}

build_only=false
runs="$default_runs"
seconds=0
names=()
while [ "$#" -gt 0 ]; do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --build-only) build_only=true ;;
    --runs | --seconds)
      [[ "${2:-}" =~ ^[0-9]+$ ]] || fail "$1 is '${2:-}', expected a whole number."
      if [ "$1" = --runs ]; then runs="$2"; else seconds="$2"; fi
      shift ;;
    -*) fail "unknown option '$1'; expected --runs, --seconds, --build-only or --help." ;;
    *)
      harness_names | grep -qxF -- "$1" || fail "there is no harness '$1', expected one of: $(harness_names | paste -sd' ')."
      names+=("$1") ;;
  esac
  shift
done
if [ "${#names[@]}" -eq 0 ]; then mapfile -t names < <(harness_names); fi

more_packages=(clang)
more_optional_packages=(libclang-rt-dev)
set_up -DLSTM_PLANNER_FUZZERS=ON -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ "${names[@]/#/fuzz_}"
if [ "$build_only" = true ]; then exit 0; fi

stay_in_workspace
failed=()
for name in "${names[@]}"; do run_fuzzer "$name" || failed+=("$name"); done
[ "${#failed[@]}" -eq 0 ] || fail "failures in: ${failed[*]}"
say "nothing failed"
