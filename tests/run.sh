#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# run.sh: installs what is missing, checks the style, builds by gcc, and runs all tests. The last line
# reports how many tests and checks passed, failed and were skipped in all runs.
#
# Options:
#   --sanitizers        then runs the tests of the library and the elements again, built by clang with
#                       AddressSanitizer and UndefinedBehaviorSanitizer, and those with threads under
#                       ThreadSanitizer; CI=true means this option
#   --thorough          the release build also runs the suite thorough, the sanitizers run all tests, the
#                       programs and scripts too (those that measure accuracy or time with fewer cases),
#                       clang-tidy checks the sources, and the Debian packages are built and used in minimal
#                       systems
#   --summarize FILE... only add up the results in saved outputs of 'meson test'
#
# Builds into build/, build-clang-asan/ and build-clang-tsan/. With CI=true warnings are errors, and the tests
# of the core also run on 64-bit ARM, emulated by QEMU, in build-aarch64/. Compilers run through ccache if it
# is installed. A new build folder compiles few large files, which takes a quarter of the time for tests and half of
# it for programs; --thorough compiles the library and the elements file by file.
# Whoever edits may prefer -Dunity=off and -Dunity_programs=false, which stay as they are in a build folder.
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

sanitizers=no thorough=no
[ "${CI:-}" != true ] || sanitizers=yes
case ${1:-} in
  --sanitizers) sanitizers=yes ;;
  --thorough) sanitizers=yes thorough=yes ;;
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
    echo "run.sh: there is no option $1 (--help lists them)" >&2
    exit 2
    ;;
esac

# Meson looks for ccache itself unless a compiler is named. Clang's precompiled headers name files of the build
# folder, so ccache must not share them between folders, even if its configuration allows that.
export CCACHE_HASHDIR=true
clang=clang
[ -z "$(command -v ccache)" ] || clang='ccache clang'

log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT

# build FOLDER TARGET OPTION...: configures and builds. A build that fails counts as a failed test. More compilers
# than processors take turns with the caches, which costs a sixth of the time.
build() {
  local folder=$1 target=$2 how=(-Dunity=on -Dunity_programs=true -Dunity_size=40)
  shift 2
  echo "== Building $folder"
  [ ! -e "$folder/build.ninja" ] || how=(--reconfigure)
  local ci=false
  [ "${CI:-}" != true ] || ci=true
  if meson setup "${how[@]}" "$folder" "$repository" -Dwerror="$ci" "$@" >"$log" 2>&1 &&
    ninja -j "$(nproc)" -C "$folder" "$target" >"$log" 2>&1; then
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
  meson test -C "$folder" --print-errorlogs "$@" 2>&1 | tee "$log" || status=$?
  if ! add_results "$log" && [ "$status" -ne 0 ]; then
    echo "== meson test ended with $status and without results"
    failed=$((failed + 1))
  fi
}

# check NAME: runs one check of tests/checks.sh, which counts as one test.
check() {
  echo "== Checking $1"
  if ./tests/checks.sh "$1" >"$log" 2>&1; then
    passed=$((passed + 1))
  else
    cat "$log"
    echo "== The check $1 failed"
    failed=$((failed + 1))
  fi
}

# Programs without a sanitizer, such as gst-launch-1.0, load libraries with one, so they have to load the
# sanitizer's own library first. The test programs are checked for leaks; those programs are not.
test_scripts_with_asan() {
  LD_PRELOAD=$asan_library ASAN_OPTIONS=detect_leaks=0 \
    run_tests build-clang-asan --no-rebuild --suite pipelines -t 5
}

marks=(checks)
[ "$sanitizers" = no ] || marks+=(sanitizers)
[ "$thorough" = no ] || marks+=(debian)
[ "${CI:-}" != true ] || marks+=(arm)
./pipelines/install-packages.sh "${marks[@]}" || { echo "packages are missing" >&2 && exit 1; }

check format
check shell
check python

large=() suites=(--no-suite thorough)
[ "$thorough" = no ] || { large=(-Dunity=off) suites=() && export MTSTEREO_PACKAGES=yes; }
if build build all -Dbuildtype=release "${large[@]}"; then
  run_tests build --no-rebuild "${suites[@]}"
fi

# Feature: leaks, sanitizers, fuzzing
if [ "$sanitizers" = yes ]; then
  export LSAN_OPTIONS=suppressions=$repository/tests/lsan.supp:print_suppressions=0
  export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
  # GStreamer's helper that reads plugins is built without a sanitizer and would reject them.
  export GST_REGISTRY_FORK=no

  # The sanitizer's library is shared, as the programs above need it.
  asan_library=$(clang++ -print-file-name=libclang_rt.asan-x86_64.so)
  shared_asan="-shared-libasan -Wl,-rpath,${asan_library%/*}"
  # clang-tidy reads how each file is compiled.
  tools=disabled large=() suites=(--suite core --suite geometry --suite gst --suite fuzz)
  [ "$thorough" = no ] || tools=enabled large=(-Dunity=off -Dunity_programs=false) suites=(--no-suite pipelines)
  if CC=$clang CXX=$clang++ build build-clang-asan all -Dbuildtype=debugoptimized \
    -Db_sanitize=address,undefined -Db_lundef=false -Dtools=$tools -Dprograms=$tools \
    "${large[@]}" \
    -Dc_link_args="$shared_asan" -Dcpp_link_args="$shared_asan"; then
    run_tests build-clang-asan --no-rebuild "${suites[@]}" -t 5
    if [ "$thorough" = yes ]; then
      test_scripts_with_asan
      check tidy
    fi
  fi

  if CC=$clang CXX=$clang++ build build-clang-tsan threads-tests -Dbuildtype=debugoptimized \
    -Doptimization=1 -Db_sanitize=thread -Db_lundef=false -Dgst=disabled -Dtools=disabled; then
    run_tests build-clang-tsan --no-rebuild --suite threads -t 5
  fi
fi

# Each file compiles alone here, as in the builds of those who do not use this script.
if [ "${CI:-}" = true ] && build build-aarch64 all --cross-file tests/cross/aarch64.txt \
  -Dunity=off -Dunity_programs=false -Dbuildtype=release -Dgst=disabled -Dtools=disabled; then
  # What depends on the processor: kernels, types and results. Allocations and pages do not.
  run_tests build-aarch64 --no-rebuild -t 10 core core-second core-threads step-instructions
fi

summary
