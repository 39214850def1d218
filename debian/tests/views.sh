# SPDX-License-Identifier: LGPL-2.1-or-later
# shellcheck shell=bash
# Sourced by the tests. The views are 320x240 pixels of noise; the right camera sees everything 8 px further to the
# left, so every disparity is 8 px.

cd "${AUTOPKGTEST_TMP:?is set by autopkgtest}" || exit 1

fail() {
  echo "failed: $*" >&2
  exit 1
}

# views LEFT RIGHT: runs a pipeline, in which both words are replaced by what takes the views.
views() {
  local frames=$1 left=$2 right=$3
  # The arguments are split into elements on purpose.
  # shellcheck disable=SC2086
  gst-launch-1.0 -q videotestsrc pattern=snow num-buffers="$frames" ! \
    video/x-raw,format=GRAY8,width=328,height=240 ! tee name=noise \
    noise. ! queue ! videocrop right=8 ! $left noise. ! queue ! videocrop left=8 ! $right
}

# Fails unless nine of ten 16-bit values of a map are 8 px, in units of 1/256 px.
require_8_px() {
  local found
  found=$(od -An -v -t u2 -w2 "$1" | awk '$1 > 2040 && $1 < 2056' | wc -l)
  echo "$1: $found of 76800 pixels are at 8 px"
  [ "$found" -gt 69120 ] || fail "$1 is wrong"
}
