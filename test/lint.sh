#!/usr/bin/env bash
# Checks sources, public headers, shell scripts and the catkin package; see --help.
set -uo pipefail

usage() {
  cat <<'USAGE'
Usage: bash test/lint.sh

clang-format on C++, doxygen on public headers, shellcheck on shell scripts, catkin_lint on the package: says what each of them finds. What is not
installed is left out with a line; so is a clang-format that is not of version 14, as others format otherwise.

Exit status: 0 when nothing was found.
USAGE
}

case "${1:-}" in
  '') ;;
  --help | -h) usage; exit 0 ;;
  *) echo "lint: unknown argument '$1'; expected --help or nothing." >&2; exit 2 ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
status=0

scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

left_out() { echo "lint: $1 is left out: $2"; }

# Files of the package with one of the endings ($@), one a line; works without git, too.
files_ending_with() {
  local ending
  for ending in "$@"; do
    find .ci include launch models src test -path src/tools/external -prune -o -name "*$ending" -type f -print
  done | sort
}

if ! command -v clang-format >/dev/null; then
  left_out clang-format 'it is not installed'
elif ! clang-format --version | grep -q 'version 14\.'; then
  left_out clang-format "version 14 is needed, this is $(clang-format --version)"
else
  files_ending_with .cpp .hpp | xargs clang-format --dry-run -Werror || status=1
fi

if command -v shellcheck >/dev/null; then
  { files_ending_with .sh; echo .ci/run; } | xargs shellcheck -x || status=1
else
  left_out shellcheck 'it is not installed'
fi

# What config/rosdoc.yaml says of $1.
rosdoc_setting() { sed -n "s/^ *$1: '\\(.*\\)'$/\\1/p" config/rosdoc.yaml; }

# Public headers, as rosdoc_lite finds them in a catkin workspace: comments that name a parameter or a class which does not
# exist, markup that nothing understands, and headers that its patterns leave out.
if ! command -v doxygen >/dev/null; then
  left_out doxygen 'it is not installed'
elif ! doxygen --version | grep -q '^1\.9'; then
  left_out doxygen "version 1.9 is needed, this is $(doxygen --version)"
else
  pages="$scratch/pages"
  mkdir -p "$pages/workspace/src"
  ln -s "$PWD" "$pages/workspace/src/lstm_planner"
  doxygen - <<DOXYGEN || status=1
OUTPUT_DIRECTORY = $pages
INPUT = $pages/workspace/src/lstm_planner
FILE_PATTERNS = $(rosdoc_setting file_patterns)
EXCLUDE_PATTERNS = $(rosdoc_setting exclude_patterns)
RECURSIVE = YES
STRIP_FROM_PATH = $pages/workspace/src/lstm_planner/include
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_AS_ERROR = FAIL_ON_WARNINGS
DOXYGEN
  # Doxygen 1.9.1 does not strip the paths in its XML.
  differing="$(comm -3 <(cd include && find . -name '*.hpp' -printf '%P\n' | sort) \
    <(find "$pages/xml" -name '*_8hpp.xml' -exec sed -nE 's#.*<location file="([^"]*/include/)?([^"]*\.hpp)".*#\2#p' {} + | sort -u))"
  if [ -n "$differing" ]; then
    echo "lint: config/rosdoc.yaml leaves out headers of include/ (left), or lets in others (right):" >&2
    head -n 20 <<<"$differing" >&2
    status=1
  fi
fi

# It fails with variables of a newer ROS. The package's dependencies are those of Noetic. It leaves a cache in the home.
if command -v catkin_lint >/dev/null; then
  found="$(HOME="$scratch" ROS_DISTRO=noetic catkin_lint -W1 --strict --offline . 2>&1 | grep -v -e "rosdep database" -e "unknown dependencies" \
    -e "additional notices" -e "have been ignored" -e "^catkin_lint: checked")"
  if [ -n "$found" ]; then
    echo "$found"
    status=1
  fi
else
  left_out catkin_lint 'it is not installed'
fi
exit "$status"
