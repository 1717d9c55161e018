#!/usr/bin/env bash
# Builds and tests the package in a bare Debian; see --help.
set -uo pipefail

source_dir="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"

usage() {
  cat <<'USAGE'
Usage: bash test/on_debian.sh [--demo-only | --without-ros] RELEASE

Makes a bare Debian of that release with debootstrap, copies the package into it, and runs there as root what a new user
runs: the RUN lines of the Dockerfile, which are the two commands of README.md, and then all tests; with warnings as
errors. Removes the Debian afterwards. Takes an hour on two cores, and 8 GB of disk.

Needs root (chroot, mounts), debootstrap, and the network: the packages come from where apt on this computer gets those
of Debian. Nothing is mounted outside the script's own mount namespace, so nothing is left behind if it is killed but
its folder.

Arguments:
  RELEASE        13 or trixie, 12 or bookworm, 11 or bullseye, testing or forky. On 11 the compiler is g++-9: that Debian
                 is the nearest there is to Ubuntu 20.04
  --demo-only    without the tests: the RUN lines only
  --without-ros  instead of all that: the packages of models/embed.md, and test/without_ros.sh; a quarter of an hour
  --help         this text

Environment:
  LSTM_PLANNER_SHARED   data for tests on real maps and recordings; default: shared/ beside the checkout, if it is there
  LSTM_PLANNER_LIMIT    longest time for everything, as `timeout` reads it; default 4h
  TMPDIR                where the Debian is made; default /var/tmp

Exit status: 0 when everything passed, 124 when the time was up.
USAGE
}

say() { printf 'on_debian: %s\n' "$*"; }

fail() {
  printf 'on_debian: %s\n' "$*" >&2
  exit 1
}

# Where apt gets Debian's own packages from.
mirror_of_apt() {
  # shellcheck disable=SC2016  # apt's own variables
  apt-get indextargets --format '$(ORIGIN)|$(LABEL)|$(REPO_URI)' 'Created-By: Packages' |
    awk -F'|' '$1 == "Debian" && $2 == "Debian" {print $3; exit}'
}

make_debian() {
  local codename="$1" target="$2" mirror script
  mirror="$(mirror_of_apt)"
  [ -n "$mirror" ] || fail "apt on this computer has no source of Debian's packages (apt-get indextargets)."
  script="/usr/share/debootstrap/scripts/$codename"
  [ -e "$script" ] || script=/usr/share/debootstrap/scripts/sid # a debootstrap that is older than the release
  say "making a bare Debian $codename in $target"
  timeout --kill-after=30s 30m debootstrap --variant=minbase "$codename" "$target" "$mirror" "$script" >"$target.log" 2>&1 ||
    fail "debootstrap failed: $(tail -n 1 "$target.log")"
  echo force-unsafe-io >"$target/etc/dpkg/dpkg.cfg.d/unsafe-io" # it is thrown away; half an hour of waiting for the disk
  echo 'Acquire::Check-Valid-Until "false";' >"$target/etc/apt/apt.conf.d/90old-mirror" # a copy of Debian may be weeks old
}

# The sources as they are here, committed or not.
copy_sources() {
  mkdir -p "$1"
  tar --create --exclude-vcs --exclude-vcs-ignores --directory "$source_dir" . | tar --extract --directory "$1"
}

# In the mount and process namespaces that end with this script.
mount_system() {
  local target="$1"
  mount --make-rprivate /
  mount --types proc proc "$target/proc"
  mount --rbind --make-rslave /sys "$target/sys"
  mount --rbind --make-rslave /dev "$target/dev"
  cp --dereference /etc/resolv.conf /etc/hosts "$target/etc/"
  if [ -n "$shared" ]; then
    mkdir -p "$target/shared"
    mount --bind "$shared" "$target/shared"
  fi
}

# What is run in the Debian.
commands() {
  echo 'set -ex'
  echo 'export HOME=/root LANG=C.UTF-8 CXXFLAGS=-Werror LSTM_PLANNER_SHARED=/shared DEBIAN_FRONTEND=noninteractive'
  echo 'export PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin'
  echo 'cd /lstm_planner'
  [ "$1" != bullseye ] ||
    echo 'apt-get update; apt-get install -y --no-install-recommends g++-9; export CC=gcc-9 CXX=g++-9'
  if [ "$what" = without-ros ]; then
    echo 'apt-get update'
    sed -n 's/^sudo apt-get install/apt-get install -y/p' "$source_dir/models/embed.md"
    echo 'bash test/without_ros.sh'
    return
  fi
  sed -n 's/^RUN //p' "$source_dir/launch/Dockerfile"
  [ "$what" = demo-only ] || echo 'bash test/run.sh'
}

# With the namespaces: everything from the mounts to the exit status of the last command.
run_inside() {
  local codename="$1" target="$2"
  mount_system "$target" || fail "cannot mount /proc, /sys and /dev in $target."
  commands "$codename" >"$target/commands.sh"
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM="${TERM:-dumb}" chroot "$target" bash /commands.sh </dev/null
}

what=all
release=
for argument in "$@"; do
  case "$argument" in
    --help | -h) usage; exit 0 ;;
    --demo-only | --without-ros) what="${argument#--}" ;;
    13 | trixie) release=trixie ;;
    12 | bookworm) release=bookworm ;;
    11 | bullseye) release=bullseye ;;
    testing | forky) release=forky ;;
    *) fail "unknown argument '$argument'; expected 13, 12, 11, testing, --demo-only, --without-ros or --help." ;;
  esac
done
[ -n "$release" ] || fail "which release? 13, 12, 11 or testing; see --help."

shared="${LSTM_PLANNER_SHARED:-$source_dir/../shared}"
[ -d "$shared" ] || shared=

# Called again by itself, see below.
if [ -n "${ON_DEBIAN_TARGET:-}" ]; then
  run_inside "$release" "$ON_DEBIAN_TARGET"
  exit
fi

[ "$(id -u)" -eq 0 ] || fail "this needs root."
command -v debootstrap >/dev/null || fail "this needs debootstrap: apt-get install debootstrap"
folder="$(TMPDIR="${TMPDIR:-/var/tmp}" mktemp --directory --tmpdir lstm_planner_debian.XXXXXX)" || exit 1
# shellcheck disable=SC2064  # the name is known now
trap "rm -rf --one-file-system '$folder'" EXIT
trap 'exit 130' INT TERM

make_debian "$release" "$folder/debian"
copy_sources "$folder/debian/lstm_planner"
begin="$SECONDS"
ON_DEBIAN_TARGET="$folder/debian" timeout --kill-after=30s "${LSTM_PLANNER_LIMIT:-4h}" \
  unshare --mount --pid --fork --kill-child bash "${BASH_SOURCE[0]}" "$@"
status=$?
say "Debian $release: exit status $status after $(((SECONDS - begin) / 60)) minutes"
exit "$status"
