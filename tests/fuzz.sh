#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# fuzz.sh: runs the fuzzing programs of tests/fuzz/ for as long as wanted, with clang's libFuzzer, AddressSanitizer and
# UndefinedBehaviorSanitizer. What they learn is kept, so that the next run continues.
#
# usage: fuzz.sh [--minutes N] [--folder FOLDER] [TARGET...]
#   --minutes N      time for each target (default 10)
#   --folder FOLDER  keeps the inputs: FOLDER/TARGET/corpus, and FOLDER/TARGET/crash-* and the like for those that
#                    fail (default ~/.local/share/mtstereo-fuzz)
#   TARGET           alignment, calibration, caps, files, matcher, media, streams or text (default: all)
#
# Builds into build-clang-asan/. To keep an input that failed as a test, copy it to tests/fuzz/regressions/TARGET/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
known=(alignment calibration caps files matcher media streams text)

usage() {
  sed -n -e '1,2d' -e '/^#/!q' -e 's/^# \{0,1\}//p' "$0"
}

wrong() {
  echo "fuzz.sh: $1 (--help lists the options)" >&2
  exit 2
}

minutes=10
folder=${XDG_DATA_HOME:-$HOME/.local/share}/mtstereo-fuzz
targets=()
while [ $# -gt 0 ]; do
  case $1 in
    --minutes)
      [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || wrong "--minutes needs a number above 0"
      minutes=$2
      shift
      ;;
    --folder)
      [ -n "${2:-}" ] || wrong "--folder needs a folder"
      folder=$2
      shift
      ;;
    --help | -h)
      usage
      exit 0
      ;;
    *)
      [[ " ${known[*]} " == *" $1 "* ]] || wrong "there is no target or option $1"
      targets+=("$1")
      ;;
  esac
  shift
done
[ ${#targets[@]} -gt 0 ] || targets=("${known[@]}")

build="build-clang-asan"
if [ ! -e "$build/build.ninja" ]; then
  # As tests/run.sh configures it.
  asan_library=$(clang++ -print-file-name=libclang_rt.asan-x86_64.so)
  shared_asan="-shared-libasan -Wl,-rpath,${asan_library%/*}"
  CC=clang CXX=clang++ meson setup "$build" -Dbuildtype=debugoptimized -Db_sanitize=address,undefined \
    -Db_lundef=false -Dc_link_args="$shared_asan" -Dcpp_link_args="$shared_asan"
fi
ninja -C "$build" fuzz

failed=()
for target in "${targets[@]}"; do
  mkdir -p "$folder/$target/corpus"
  echo "== $target: $minutes minutes, inputs in $folder/$target"
  ./tests/fuzz/fuzz_test.sh "$build/tests/fuzz/fuzz-$target" "$target" "$build/tests/fuzz/seeds/$target" \
    "tests/fuzz/regressions/$target" $((minutes * 60)) "$folder/$target" || failed+=("$target")
done
[ ${#failed[@]} -eq 0 ] || { echo "failed: ${failed[*]}" && exit 1; }
echo "no failure"
