#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# from-cameras.sh LEFT RIGHT: disparity of two video4linux cameras.
#
#   ./pipelines/from-cameras.sh /dev/video0 /dev/video2
#   ./pipelines/from-cameras.sh /dev/video0 /dev/video2 --size 640x480 --rate 30
#
# The cameras have to be mounted and rectified such that a point lies on the same row in both
# pictures, and to take their pictures at the same moment (an external trigger): mtstereo pairs
# frames whose time stamps differ by less than half a frame, and drops others.
#
# Options:
#   --size WxH          what to ask the cameras for (default 640x480)
#   --rate N            frames per second to ask for (default 30)
set -euo pipefail
# shellcheck source=pipelines/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

size=640x480
rate=30
own_option() {
  case $1 in
    --size) size=$2 ;;
    --rate) rate=$2 ;;
    *) return 1 ;;
  esac
}
parse_options "$@"
[ ${#arguments[@]} -eq 2 ] || wrong_usage "two cameras are needed, such as /dev/video0 /dev/video2"
[[ $size =~ ^([0-9]+)x([0-9]+)$ ]] || wrong_usage "--size is '$size', it has to look like 640x480"
wanted="width=${BASH_REMATCH[1]},height=${BASH_REMATCH[2]}"
is_number "$rate" || wrong_usage "--rate is '$rate', it has to be a whole number"
wanted+=",framerate=$rate/1"
if [ "$dry_run" = no ]; then
  for camera in "${arguments[@]}"; do
    [ -c "$camera" ] || fail "there is no camera $camera"
  done
fi

# Raw or MJPEG, whatever the camera has at this size; decodebin lets raw pass.
caps="video/x-raw,$wanted;image/jpeg,$wanted"
mapfile -t output < <(output_of)
launch \
  v4l2src "device=${arguments[0]}" '!' "$caps" '!' decodebin '!' videoconvert '!' queue '!' m.sink_left \
  v4l2src "device=${arguments[1]}" '!' "$caps" '!' decodebin '!' videoconvert '!' queue '!' m.sink_right \
  "${matcher[@]}" "${output[@]}"
