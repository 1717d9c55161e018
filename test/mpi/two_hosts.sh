#!/usr/bin/env bash
# A training on two hosts, which are network namespaces here; see --help.
set -uo pipefail

usage() {
  cat <<'USAGE'
Usage: bash test/mpi/two_hosts.sh [TOOL]

Trains and evaluates with mpirun on two hosts that are network namespaces of this machine with a cable between them, and compares with one
process: the same model and the same checkpoint, to the byte, and the same episodes. Then the cable is pulled out of a longer training: mpirun must end it with a message within a minute,
and the same command must go on from its checkpoint to the model that one process learns without a break. TOOL is the command-line tool (default:
lstm_planner). Needs root, ip (iproute2), unshare (util-linux) and Open MPI. mpirun starts its daemon on the second host through ssh where sshd
(openssh-server) is installed, otherwise through a script that takes ssh's place. Takes a minute or two.

Exit status: 0 when all of that is so, 77 when something that it needs is missing.
USAGE
}

case "${1:-}" in
  --help | -h) usage; exit 0 ;;
esac
tool="$(command -v "${1:-lstm_planner}")" || { echo "two_hosts: there is no program '${1:-lstm_planner}'; source the workspace's setup.bash." >&2; exit 2; }
tool="$(realpath "$tool")"

missing() { echo "two_hosts: skipped, as $1." >&2; exit 77; }
[ "$(id -u)" = 0 ] || missing 'it needs root'
for needed in ip unshare mpirun cmp; do
  command -v "$needed" >/dev/null || missing "there is no $needed"
done
mpirun --version | grep -q 'Open MPI' || missing 'mpirun is not of Open MPI'

readonly first=lstm-host-1 second=lstm-host-2
folder="$(mktemp -d)"
job=
sshd=

clean_up() {
  [ -z "$job" ] || kill -KILL "$job" 2>/dev/null
  [ -z "$sshd" ] || kill "$sshd" 2>/dev/null
  ip netns del "$first" 2>/dev/null
  ip netns del "$second" 2>/dev/null
  rm -rf "$folder"
}
trap clean_up EXIT

fail() {
  echo "two_hosts: $1" >&2
  [ ! -f "${2:-}" ] || tail -20 "$2" >&2
  exit 1
}

make_hosts() {
  ip netns add "$first" && ip netns add "$second" &&
    ip link add cable1 netns "$first" type veth peer name cable2 netns "$second" &&
    ip -n "$first" addr add 10.77.0.1/24 dev cable1 && ip -n "$second" addr add 10.77.0.2/24 dev cable2 &&
    ip -n "$first" link set cable1 up && ip -n "$second" link set cable2 up &&
    ip -n "$first" link set lo up && ip -n "$second" link set lo up
}
make_hosts || missing 'network namespaces cannot be made here'

# What mpirun calls with HOST COMMAND.
make_agent() {
  local command
  if [ -x /usr/sbin/sshd ]; then
    start_sshd || fail 'sshd does not start' "$folder/sshd.log"
    command="exec ssh -i $folder/key -o BatchMode=yes -o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null \"\$@\""
  else
    command="shift; exec ip netns exec $second unshare -u sh -c \"hostname $second; \$*\""
  fi
  printf '#!/bin/sh\n%s\n' "$command" >"$folder/agent.sh"
  chmod +x "$folder/agent.sh"
}

# On the second host, for a key of this run.
start_sshd() {
  mkdir -p /run/sshd && ssh-keygen -q -N '' -t ed25519 -f "$folder/key" && ssh-keygen -q -N '' -t ed25519 -f "$folder/host_key" || return
  # shellcheck disable=SC2016
  ip netns exec "$second" unshare -u sh -c 'hostname "$0"; exec /usr/sbin/sshd "$@"' "$second" -D -e -f /dev/null -h "$folder/host_key" \
    -o AuthorizedKeysFile="$folder/key.pub" -o StrictModes=no -o UsePAM=no -o PidFile=none 2>"$folder/sshd.log" &
  sshd=$!
  until grep -q 'Server listening' "$folder/sshd.log"; do
    kill -0 "$sshd" 2>/dev/null || return
    sleep 0.1
  done
}
make_agent
printf '10.77.0.1 slots=1\n10.77.0.2 slots=1\n' >"$folder/hosts"

# The lines of the page that are not about namespaces are the options of mpirun.
on_two_hosts() {
  # shellcheck disable=SC2016
  exec ip netns exec "$first" unshare -u sh -c 'hostname "$0"; exec "$@"' "$first" \
    env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    mpirun -n 2 --hostfile "$folder/hosts" --mca plm_rsh_agent "$folder/agent.sh" \
    --mca oob_tcp_keepalive_time 5 --mca oob_tcp_keepalive_intvl 2 --mca oob_tcp_keepalive_probes 3 \
    --mca btl tcp,self --mca btl_tcp_if_include 10.77.0.0/24 --mca oob_tcp_if_include 10.77.0.0/24 "$@"
}

training() { # epochs
  echo "$tool train --task grid --method q-learning --cells 8 --map-size 64 --max-length 60 --epochs $1
    --updates $((6 * $1)) --agents 256 --goals 30 --validation 4 --threads 1 --output it.onnx --checkpoint it.checkpoint"
}

expect_same() { # folder of one process, folder of two hosts, what
  local file
  for file in it.onnx it.checkpoint; do
    cmp "$folder/$1/$file" "$folder/$2/$file" || fail "$3: $file is not that of one process"
  done
  echo "two_hosts: $3: the same model and checkpoint as by one process."
}

run_in() { # folder of its own, command
  mkdir -p "$folder/$1"
  (cd "$folder/$1" && shift && "$@" >log 2>&1) || fail "failed: ${*:2}" "$folder/$1/log"
}

# shellcheck disable=SC2046
run_in one $(training 2)
# shellcheck disable=SC2046
run_in two on_two_hosts $(training 2)
expect_same one two 'two hosts'
received="$(ip netns exec "$second" cat /sys/class/net/cable2/statistics/rx_bytes)"
[ "$received" -gt 1000000 ] || fail "only $received bytes went over the cable: the ranks did not share the work"

run_in maps "$tool" maps --kind maze --count 2 --columns 128 --rows 128 --output set
evaluation="$tool evaluate --agent boundary --scenarios $folder/maps/set --count 200 --max-steps 0 --threads 1 --details details.csv"
# shellcheck disable=SC2086
run_in one_evaluates $evaluation
# shellcheck disable=SC2086
run_in two_evaluates on_two_hosts $evaluation
for evaluated in one two; do # without the times
  cut -d, -f1-10,12- "$folder/${evaluated}_evaluates/details.csv" >"$folder/$evaluated.csv"
done
cmp "$folder/one.csv" "$folder/two.csv" || fail 'two hosts: their episodes are not those of one process'
echo "two_hosts: two hosts: the same $(($(wc -l <"$folder/two.csv") - 1)) episodes as by one process."

mkdir "$folder/broken"
# shellcheck disable=SC2046
(cd "$folder/broken" && on_two_hosts $(training 20) >log 2>&1) &
job=$!
until [ -f "$folder/broken/it.checkpoint" ]; do
  kill -0 "$job" 2>/dev/null || fail 'it ended before its first checkpoint' "$folder/broken/log"
  sleep 0.2
done
ip -n "$second" link set cable2 down
begun=$SECONDS
while kill -0 "$job" 2>/dev/null; do
  [ $((SECONDS - begun)) -lt 60 ] || fail 'a lost host did not end the run within a minute' "$folder/broken/log"
  sleep 0.5
done
wait "$job" && fail 'a lost host ended the run with status 0' "$folder/broken/log"
job=
grep -q 'lost communication' "$folder/broken/log" || fail 'nothing says that a host was lost' "$folder/broken/log"
echo "two_hosts: a lost host ended the run after $((SECONDS - begun)) s: $(grep -m1 'lost communication' "$folder/broken/log")"

ip -n "$second" link set cable2 up
# shellcheck disable=SC2046
run_in broken on_two_hosts $(training 20)
# shellcheck disable=SC2046
run_in whole $(training 20)
expect_same whole broken 'gone on from the checkpoint'
