#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# soak.sh: plays the element in hostile ways for as long as wanted: seeks, state changes, properties from three threads,
# caps that change or are wrong, wrong frames, streams that end, lose frames or arrive late, pads that are linked again,
# several elements at a time. Prints a table in Markdown (docs/quality.md explains it); fails if a pair was wrong
# without a warning, something hung, an error did not state its cause, objects leaked, or memory grew.
#
# usage: soak.sh [--minutes N] [--seed N]
#   --minutes N  duration (default 30)
#   --seed N     makes the same choices as an earlier run
#
# Builds into build/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

minutes=30
seed=()
while [ $# -gt 0 ]; do
  case $1 in
    --minutes | --seed)
      [[ ${2:-} =~ ^[0-9]+$ ]] || { echo "soak.sh: $1 needs a number" >&2 && exit 2; }
      if [ "$1" = --minutes ]; then minutes=$2; else seed=(--seed "$2"); fi
      shift
      ;;
    --help | -h)
      sed -n -e '1,2d' -e '/^#/!q' -e 's/^# \{0,1\}//p' "$0"
      exit 0
      ;;
    *)
      echo "soak.sh: there is no option $1 (--help lists them)" >&2
      exit 2
      ;;
  esac
  shift
done

[ -e build/build.ninja ] || meson setup build -Dbuildtype=release
ninja -C build tests/soak/mtstereo-soak gst/libgstmtstereo.so
exec ./build/tests/soak/mtstereo-soak --seconds $((minutes * 60)) "${seed[@]}"
