# shellcheck shell=bash
# What launch/demo.sh and the scripts in test and test/fuzz have in common: find ROS 1, install what is missing, build in a
# workspace outside the source tree, and enter that workspace's environment. To be sourced by them; does nothing by itself.
# They may set more_packages, more_optional_packages and wants_rviz.
#
#   LSTM_PLANNER_WS   the workspace; default ${XDG_CACHE_HOME:-~/.cache}/lstm_planner

more_packages=()
more_optional_packages=()
wants_rviz="${DISPLAY:-}"
source_dir="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"
workspace="${LSTM_PLANNER_WS:-${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache}/lstm_planner}"
ros_folder=/opt/ros

say() { printf 'lstm_planner: %s\n' "$*"; }

fail() {
  printf 'lstm_planner: %s\n' "$*" >&2
  exit 1
}

# ------------------------------------------------------------------------------ prerequisites

# noetic, one: packages ros-noetic-*, ros-one-* in /opt/ros; distribution: ROS 1 as Debian and Ubuntu 22.04 package it.
# The one whose environment this shell has, else one that is installed, else one that apt could install.
find_ros_flavour() {
  local flavour
  for flavour in "${ROS_DISTRO:-}" noetic one; do
    case "$flavour" in
      noetic | one) if [ -r "$ros_folder/$flavour/setup.bash" ]; then echo "$flavour"; return; fi ;;
    esac
  done
  for flavour in noetic one; do
    if [ -n "$(echo "ros-$flavour-catkin" | installable)" ]; then echo "$flavour"; return; fi
  done
  if grep -qs '^VERSION_CODENAME=focal' /etc/os-release; then echo noetic; else echo distribution; fi
}

# What the real move_base needs, of a flavour that has it.
navigation_packages() { printf "ros-$1-%s\n" costmap-2d move-base nav-core; }

# The development files of the Qt that the rviz in the package $1 is linked with.
qt_of_rviz() {
  local libraries
  libraries="$(apt-cache depends "$1" 2>/dev/null | awk '/ Depends: .*rviz/ {print $2}')"
  # shellcheck disable=SC2086  # one word a package
  case "$(apt-cache depends "$1" $libraries 2>/dev/null)" in
    *'Depends: libqt6'*) echo qt6-base-dev ;;
    *) echo qtbase5-dev ;;
  esac
}

# Debian packages the build and the tests need, one a line.
required_packages() {
  printf '%s\n' cmake g++ gnuplot-nox libboost-dev libeigen3-dev libgmock-dev \
    libgtest-dev libopencv-dev libpoco-dev libprotobuf-dev libsqlite3-dev libyaml-cpp-dev make ninja-build nlohmann-json3-dev \
    protobuf-compiler python3 "${more_packages[@]}"
  if [ "$1" != distribution ]; then
    printf "ros-$1-%s\n" actionlib actionlib-msgs catkin diagnostic-msgs diagnostic-updater geometry-msgs move-base-msgs nav-msgs \
      pluginlib rosbag rosbash roscpp rosgraph-msgs roslaunch roslib rosparam rosservice rostest sensor-msgs std-msgs \
      std-srvs tf2 tf2-geometry-msgs tf2-msgs tf2-ros visualization-msgs
    [ "$1" != noetic ] || navigation_packages "$1"
  else
    printf '%s\n' catkin libactionlib-dev libactionlib-msgs-dev libdiagnostic-msgs-dev libdiagnostic-updater-dev libgeometry-msgs-dev \
      libmove-base-msgs-dev libnav-msgs-dev libros-rosgraph-msgs-dev librosbag-dev libroscpp-dev librostest-dev \
      libsensor-msgs-dev libstd-msgs-dev libstd-srvs-dev libtf2-dev libtf2-geometry-msgs-dev libtf2-msgs-dev \
      libtf2-ros-dev libvisualization-msgs-dev pluginlib-dev python3-actionlib python3-catkin \
      python3-diagnostic-msgs python3-geometry-msgs python3-move-base-msgs python3-nav-msgs python3-rosbag \
      python3-roslaunch python3-roslib python3-rosparam python3-rosservice python3-rospy python3-rostest \
      python3-rostopic python3-sensor-msgs python3-std-msgs python3-std-srvs python3-tf2-ros \
      python3-visualization-msgs ros-environment rosbash rosout rospack-tools
  fi
}

# Packages that add something where the distribution has them: an independent reader of model files for the tests, the
# driver's own messages, parameters that change while the robot drives, the navigation stack's other planners to compare
# with, Google Benchmark, and rviz with its headers, for the panel, where somebody can see it.
optional_packages() {
  printf '%s\n' libbenchmark-dev python3-onnx "${more_optional_packages[@]}"
  if [ "$1" = distribution ]; then
    # Debian packages static_transform_publisher, which navigation.launch starts, with tf2's tools.
    printf '%s\n' libdynamic-reconfigure-config-init-mutex-dev python3-dynamic-reconfigure tf2-tools
  else
    navigation_packages "$1"
    printf "ros-$1-%s\n" create-msgs dwa-local-planner dynamic-reconfigure global-planner
  fi
  if [ -n "$wants_rviz" ]; then
    # Not all distributions' headers of rviz bring what they need.
    if [ "$1" = distribution ]; then
      printf '%s\n' libopengl-dev rviz librviz-dev "$(qt_of_rviz librviz-dev)"
    else
      printf '%s\n' libopengl-dev "ros-$1-rviz" "$(qt_of_rviz "ros-$1-rviz")"
    fi
  fi
}

# Those of the names on standard input that are not installed.
not_installed() {
  local wanted installed
  wanted="$(sort -u)"
  # shellcheck disable=SC2086  # one word a package
  installed="$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $wanted 2>/dev/null | sed -n 's/^installed //p' |
    sort -u)"
  comm -23 <(echo "$wanted") <(echo "$installed")
}

# Those of the names on standard input that apt could install.
installable() {
  xargs -r apt-cache policy 2>/dev/null |
    awk '/^[^ ]/ {sub(/:$/, ""); name = $0} /Candidate:/ && $2 != "(none)" {print name}' | sort -u
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

# Asks for the password before anything else, where somebody sits at a terminal to give it.
check_can_become_root() {
  [ "$(id -u)" -eq 0 ] && return
  local remedy="as root, run: apt-get install -y --no-install-recommends $1"
  command -v sudo >/dev/null || fail "there is no sudo here; $remedy"
  sudo -n true 2>/dev/null && return
  [ -t 0 ] || fail "sudo asks for a password and there is no terminal to ask at; $remedy"
  say "sudo is needed to install packages"
  sudo -v || fail "sudo was refused; $remedy"
}

# rosdep knows the names where its database has been initialised and updated; what it leaves is installed by name.
install_with_rosdep() {
  command -v rosdep >/dev/null && [ -e "${ROS_HOME:-$HOME/.ros}/rosdep/sources.cache/index" ] || return 0
  [ "$1" != distribution ] || return 0
  say "asking rosdep to install the dependencies in package.xml"
  ROS_DISTRO="$1" rosdep install --from-paths "$source_dir" --ignore-src --rosdistro "$1" -r -y </dev/null || true
}

# The first of many words, for a sentence that should stay readable.
some_of() {
  local shown=3
  if [ "$#" -le "$shown" ]; then echo "$*"; else echo "${*:1:shown} and $(($# - shown)) more"; fi
}

apt_install() {
  echo "--- apt-get install" >>"$workspace/apt.log"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" </dev/null \
    >>"$workspace/apt.log" 2>&1
}

# apt-get takes a server it cannot reach for a warning, unless told otherwise.
apt_update() {
  say "updating apt's package lists"
  echo "--- apt-get update" >>"$workspace/apt.log"
  as_root apt-get -o APT::Update::Error-Mode=any update </dev/null >>"$workspace/apt.log" 2>&1
}

# What apt-get's last call complained about.
apt_complaint() {
  awk '/^--- / {line = ""} /^[EW]:/ && line == "" {line = $0} END {if (line == "") exit 1; print line}' \
    "$workspace/apt.log" || echo "see $workspace/apt.log"
}

# Fails when apt knows some package ($@) not even after an update of its lists.
check_installable() {
  local unknown updated=true
  unknown="$(comm -23 <(printf '%s\n' "$@") <(printf '%s\n' "$@" | installable))"
  [ -n "$unknown" ] || return 0
  apt_update || updated=false
  unknown="$(comm -23 <(printf '%s\n' "$@") <(printf '%s\n' "$@" | installable))"
  [ -n "$unknown" ] || return 0
  # shellcheck disable=SC2086  # one word a package
  unknown="$(some_of $unknown)"
  [ "$updated" = true ] ||
    fail "apt-get does not know the packages $unknown and could not update its lists: $(apt_complaint)"
  fail "apt-get has no package $unknown; ROS 1 is packaged for Debian 11 to 13, from packages.ros.org" \
    "(see wiki.ros.org/noetic/Installation/Ubuntu) for Ubuntu 20.04, and by ROS One for Ubuntu 22.04 and 24.04."
}

# Whether this user becomes root without a password.
is_root_at_once() { [ "$(id -u)" -eq 0 ] || sudo -n true 2>/dev/null; }

# The optional packages, where all others are installed. The build goes on without them.
install_optional_packages() {
  local extra
  extra="$(optional_packages "$1" | not_installed | installable)"
  [ -n "$extra" ] || return 0
  if is_root_at_once; then
    say "installing optional packages with apt-get, log in $workspace/apt.log: ${extra//$'\n'/ }"
    # shellcheck disable=SC2086  # one word a package
    if apt_install $extra; then return; fi
  fi
  say "parts that need optional packages are left out; to get them: sudo apt-get install --no-install-recommends ${extra//$'\n'/ }"
}

install_missing_packages() {
  local flavour="$1" missing extra
  missing="$(required_packages "$flavour" | not_installed)"
  if [ -z "$missing" ]; then
    install_optional_packages "$flavour"
    return
  fi
  command -v apt-get >/dev/null || fail "missing packages: ${missing//$'\n'/ }; no apt-get here to install them with."
  check_can_become_root "${missing//$'\n'/ }"
  install_with_rosdep "$flavour"
  missing="$(required_packages "$flavour" | not_installed)"
  [ -n "$missing" ] || return 0

  # shellcheck disable=SC2086  # one word a package
  check_installable $missing
  extra="$(optional_packages "$flavour" | not_installed | installable)"
  # shellcheck disable=SC2086  # one word a package
  say "installing with apt-get, log in $workspace/apt.log:" $missing $extra
  # Lists of some weeks ago name files that the servers have replaced since.
  # shellcheck disable=SC2086  # one word a package
  apt_install $missing $extra || { apt_update && apt_install $missing $extra; } ||
    fail "apt-get could not install the packages above: $(apt_complaint)"
}

# ---------------------------------------------------------------------- environment and build

# Sources a setup file of ROS: with `set -u` they fail.
source_setup() {
  set +u
  # shellcheck disable=SC1090
  source "$1"
  set -u
}

enter_ros() {
  # ROS's python modules belong to the system's python3, whatever pyenv or conda put in front of it.
  export PATH="/usr/bin:/bin:$PATH"
  unset PYTHONHOME
  if [ "${ROS_VERSION:-}" != 1 ] && [ -r "$ros_folder/$1/setup.bash" ]; then source_setup "$ros_folder/$1/setup.bash"; fi
  command -v catkin_make >/dev/null || fail "catkin_make not found although ROS 1's packages are installed."
  export ROS_HOME="$workspace/ros_home"
  export ROS_HOSTNAME=localhost
  unset ROS_IP ROS_LOG_DIR
}

prepare_workspace() {
  workspace="$(realpath -m -- "$workspace")"
  case "$workspace/" in
    "$source_dir"/*) fail "the workspace $workspace lies inside the source tree; set LSTM_PLANNER_WS." ;;
  esac
  case "$workspace" in
    *[[:space:]]*) fail "the workspace '$workspace' has a space in its path: ROS's tools fail with one;" \
      "set LSTM_PLANNER_WS." ;;
  esac
  mkdir -p "$workspace/src" "$workspace/ros_home" 2>/dev/null || fail "cannot create the workspace $workspace."
  if [ ! -w "$workspace" ] || [ ! -w "$workspace/src" ]; then fail "cannot write to the workspace $workspace."; fi
}

# Objects of another checkout may be newer than this one's sources, so make alone would not notice the change.
link_checkout() {
  local link="$workspace/src/lstm_planner"
  if [ -L "$link" ] && [ "$(readlink -f "$link")" != "$source_dir" ]; then
    say "the workspace $workspace was built from another checkout; building everything again"
    rm -rf "$workspace/build" "$workspace/devel"
  fi
  if [ -e "$link" ] && [ ! -L "$link" ]; then
    fail "$link exists and is no link to a checkout; choose another workspace with LSTM_PLANNER_WS."
  fi
  ln -sfn "$source_dir" "$link"
}

# A compiler run takes up to a gigabyte.
parallel_jobs() {
  local processors gigabytes
  processors="$(nproc)"
  gigabytes="$(awk '/MemAvailable/ {print int($2 / 1048576)}' /proc/meminfo 2>/dev/null)"
  if [ -n "$gigabytes" ] && [ "$gigabytes" -lt "$processors" ]; then processors="$gigabytes"; fi
  [ "$processors" -ge 1 ] || processors=1
  echo "$processors"
}

# Debian 11's catkin does not look for GMock again where its cache says that it is there, and then lacks its targets.
forget_gmock() {
  grep -q '^VERSION_CODENAME=bullseye' /etc/os-release 2>/dev/null || return 0
  [ ! -e "$workspace/build/CMakeCache.txt" ] || sed -i '/^GMOCK_FOUND:/d' "$workspace/build/CMakeCache.txt"
}

# Ninja compiles a library while those that it is linked with are built; make waits for them. A build folder keeps what it began with.
builder() {
  local cache="$workspace/build/CMakeCache.txt"
  if [ ! -e "$cache" ] || grep -q '^CMAKE_GENERATOR:INTERNAL=Ninja$' "$cache"; then echo --use-ninja; fi
}

build_targets() {
  local log="$workspace/build.log" status
  say "building in $workspace (log: $log)"
  # CMake 4 refuses what catkin's own files ask for.
  export CMAKE_POLICY_VERSION_MINIMUM="${CMAKE_POLICY_VERSION_MINIMUM:-3.5}"
  # Optional packages may have been installed since it was configured. A unity build from nothing takes three quarters of the time.
  # shellcheck disable=SC2046
  catkin_make -C "$workspace" $(builder) --force-cmake -j"$(parallel_jobs)" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PROJECT_lstm_planner_INCLUDE="$source_dir/src/unity_build.cmake" \
    -DCMAKE_CXX_FLAGS="${CXXFLAGS:-}" -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 "$@" </dev/null 2>&1 | tee "$log" |
    grep --line-buffered -E '^\[ *[0-9]+(%|/[0-9]+)\] (Building|Linking)|warning:|error:|undefined reference|\*\*\*|^CMake Error'
  status="${PIPESTATUS[0]}"
  [ "$status" -eq 0 ] || fail "the build failed; its errors are above, everything is in $log."
}

# Where ROS has the real one, the package's own move_base should surprise nobody.
say_which_move_base() {
  [ "$1" != distribution ] && [ -x "$workspace/devel/lib/lstm_planner/standalone_move_base" ] || return 0
  say "ATTENTION: the navigation stack is not installed. This package's standalone_move_base was built in place of" \
    "move_base; it has no costmaps. To get the real one, run this again after:" \
    "sudo apt-get install $(navigation_packages "$1" | paste -sd' ')"
}

# All steps; the arguments are targets.
set_up() {
  local flavour
  prepare_workspace
  flavour="$(find_ros_flavour)"
  install_missing_packages "$flavour"
  enter_ros "$flavour"
  exec 9>"$workspace/lock"
  flock 9 || fail "cannot lock the workspace $workspace."
  link_checkout
  forget_gmock
  build_targets "$@"
  exec 9>&-
  say_which_move_base "$flavour"
  source_setup "$workspace/devel/setup.bash"
}

# For tests: whatever they write is in the workspace.
stay_in_workspace() {
  rm -rf "${workspace:?}/home" "${workspace:?}/tmp"
  mkdir -p "$workspace/home" "$workspace/tmp" || fail "cannot create folders for the tests in the workspace $workspace."
  export HOME="$workspace/home" TMPDIR="$workspace/tmp" PYTHONDONTWRITEBYTECODE=1
  unset XDG_CACHE_HOME XDG_CONFIG_HOME XDG_DATA_HOME XDG_RUNTIME_DIR XDG_STATE_HOME
}
