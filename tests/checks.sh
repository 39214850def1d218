#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# checks.sh: checks the sources without running them. It fails if a check finds something.
#
# usage: checks.sh CHECK
#   format   clang-format of all C and C++ files
#   shell    shellcheck of all shell scripts
#   python   pyflakes of all Python files
#   tidy     clang-tidy of core/, gst/ and pipelines/, as build-clang-asan/ compiles them
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folders=(core debian docs gst pipelines tests)

format() {
  find "${folders[@]}" '(' -name '*.[ch]' -o -name '*.[ch]pp' ')' -print0 |
    xargs -0 clang-format-14 --dry-run -Werror
}

shell() {
  find "${folders[@]}" -name '*.sh' -print0 | xargs -0 shellcheck .ci/run
}

python() {
  find "${folders[@]}" -name '*.py' -print0 | xargs -0 pyflakes3
}

# Of the SIMD targets one is enough: the others compile the same source.
tidy() {
  run-clang-tidy-14 -quiet -p build-clang-asan -extra-arg=-DHWY_COMPILE_ONLY_STATIC \
    "$PWD/(core|gst|pipelines)/.*\\.cpp"
}

case ${1:-} in
  format | shell | python | tidy) "$1" ;;
  *)
    sed -n -e '1,2d' -e '/^#/!q' -e 's/^# \{0,1\}//p' "$0" >&2
    exit 2
    ;;
esac
