#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# run.sh: installs what is missing, builds, and runs all tests: the release build, then the same
# tests under AddressSanitizer and UndefinedBehaviorSanitizer, then the tests with threads under
# ThreadSanitizer. The last line tells how many passed, failed and were skipped over all runs.
#
# Options:
#   --quick             the release build alone
#   --summarize FILE... only add up the results in saved outputs of 'meson test'
#
# Builds into build/, build-asan/ and build-tsan/. With CI=true warnings are errors.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
repository=$PWD

passed=0 failed=0 skipped=0

# Adds a count of meson's summary, as in "Fail:   3", to a variable.
count() {
  sed -n "s/^$2: *\([0-9][0-9]*\) *$/\1/p" "$1" | awk '{ sum += $1 } END { print sum + 0 }'
}

add_results() {
  local ok fail
  ok=$(($(count "$1" Ok) + $(count "$1" 'Expected Fail')))
  fail=$(($(count "$1" Fail) + $(count "$1" 'Unexpected Pass') + $(count "$1" Timeout)))
  passed=$((passed + ok)) failed=$((failed + fail))
  skipped=$((skipped + $(count "$1" Skipped)))
  [ $((ok + fail)) -gt 0 ]
}

summary() {
  echo
  echo "$passed passed, $failed failed, $skipped skipped"
  [ "$failed" -eq 0 ]
}

quick=no
case ${1:-} in
  --quick) quick=yes ;;
  --summarize)
    shift
    [ $# -gt 0 ] || { echo "run.sh: --summarize needs a file" >&2 && exit 2; }
    for file in "$@"; do
      [ -r "$file" ] || { echo "run.sh: there is no file $file" >&2 && exit 2; }
      add_results "$file" || failed=$((failed + 1)) # an output without results is no success
    done
    summary
    exit
    ;;
  --help | -h)
    sed -n -e '1,2d' -e '/^#/!q' -e 's/^# \{0,1\}//p' "$0"
    exit 0
    ;;
  '') ;;
  *)
    echo "run.sh: there is no option $1 (--help tells more)" >&2
    exit 2
    ;;
esac

log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT

# build FOLDER OPTION...: configures and builds. A build that fails counts as a failed test.
build() {
  local folder=$1 again=()
  shift
  echo "== Building $folder"
  [ ! -e "$folder/build.ninja" ] || again=(--reconfigure)
  local werror=false
  [ "${CI:-}" != true ] || werror=true
  if meson setup "${again[@]}" "$folder" "$repository" -Dwerror="$werror" "$@" >"$log" 2>&1 &&
    ninja -C "$folder" >"$log" 2>&1; then
    return 0
  fi
  cat "$log"
  echo "== $folder was not built"
  failed=$((failed + 1))
  return 1
}

# run_tests FOLDER ARGUMENT...: runs tests of a build and adds their results.
run_tests() {
  local folder=$1 status=0
  shift
  echo "== Testing $folder $*"
  meson test -C "$folder" --no-rebuild --print-errorlogs "$@" 2>&1 | tee "$log" || status=$?
  if ! add_results "$log" && [ "$status" -ne 0 ]; then
    echo "== meson test ended with $status and without results"
    failed=$((failed + 1))
  fi
}

# gst-launch-1.0 and other programs without a sanitizer load libraries with one: the sanitizer's own
# library has to be there first. Leaks are looked for in the test programs, not in those.
test_scripts_with_asan() {
  LD_PRELOAD=$(g++ -print-file-name=libasan.so) \
    ASAN_OPTIONS=detect_leaks=0 run_tests build-asan --suite pipelines -t 5
}

./pipelines/install-packages.sh || { echo "packages are missing" >&2 && exit 1; }

if build build -Dbuildtype=release; then
  run_tests build
fi

if [ "$quick" = no ]; then
  export LSAN_OPTIONS=suppressions=$repository/tests/lsan.supp:print_suppressions=0
  export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
  # GStreamer's helper that looks into plugins has no sanitizer in it, and would refuse them.
  export GST_REGISTRY_FORK=no
  if build build-asan -Dbuildtype=debugoptimized -Db_sanitize=address,undefined -Db_lundef=false; then
    run_tests build-asan --no-suite pipelines -t 5
    test_scripts_with_asan
  fi
  if build build-tsan -Dbuildtype=debugoptimized -Db_sanitize=thread -Db_lundef=false \
    -Dgst=disabled -Dtools=disabled; then
    run_tests build-tsan --suite threads -t 5
  fi
fi

summary
