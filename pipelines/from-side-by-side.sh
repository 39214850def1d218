#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# from-side-by-side.sh SOURCE: computes the disparity of one stream with both views side by side.
#
#   ./pipelines/from-side-by-side.sh side-by-side.mp4
#   ./pipelines/from-side-by-side.sh /dev/video0 --size 2560x720
#
# The left half is the left view. A tee splits the stream, and each branch crops one half away. Both
# halves have the same time stamp, so every frame has its partner.
#
# Options:
#   --size WxH          size of the whole image (default: 2560x720 for a camera, the size of a file)
set -euo pipefail
# shellcheck source=pipelines/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

size=
own_option() {
  [ "$1" = --size ] || return 1
  size=$2
}
parse_options "$@"
[ ${#arguments[@]} -eq 1 ] || wrong_usage "one file or camera is required"
input=${arguments[0]}
camera=no
[[ $input != /dev/* ]] || camera=yes

# The width of the decoded video of a file.
width_of_file() {
  timeout 60 gst-launch-1.0 -v filesrc "location=$1" '!' decodebin '!' video/x-raw '!' \
    fakesink num-buffers=1 2>/dev/null |
    sed -n 's/.*fakesink.*sink: caps = .*width=(int)\([0-9]*\).*/\1/p' | head -n 1
}

[[ -z $size || $size =~ ^[0-9]+x[0-9]+$ ]] ||
  wrong_usage "--size is '$size'; expected WIDTHxHEIGHT, such as 2560x720"
if [ "$camera" = yes ]; then
  size=${size:-2560x720}
  [ "$dry_run" = yes ] || [ -c "$input" ] || fail "no such camera: $input"
elif [ -z "$size" ]; then
  require_file "$input"
  width=$(width_of_file "$input" || true)
  [ -n "$width" ] || fail "$input contains no video that can be decoded"
  size=${width}x0
fi
width=${size%x*} height=${size#*x}
[ $((width % 2)) -eq 0 ] || fail "the image is $width px wide; two equal halves need an even width"

mapfile -t source < <(source_of "$input")
if [ "$camera" = yes ]; then
  source+=('!' "video/x-raw,width=$width,height=$height;image/jpeg,width=$width,height=$height")
fi
half=$((width / 2))
mapfile -t output < <(output_of)
launch \
  "${source[@]}" '!' decodebin '!' videoconvert '!' video/x-raw,format=GRAY8 '!' tee name=both \
  both. '!' queue '!' videocrop "right=$half" '!' m.sink_left \
  both. '!' queue '!' videocrop "left=$half" '!' m.sink_right \
  "${matcher[@]}" "${output[@]}"
