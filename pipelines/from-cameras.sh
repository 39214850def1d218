#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# from-cameras.sh LEFT RIGHT: computes the disparity of two video4linux cameras.
#
#   ./pipelines/from-cameras.sh /dev/video0 /dev/video2
#   ./pipelines/from-cameras.sh /dev/video0 /dev/video2 --size 640x480 --rate 30
#   ./pipelines/from-cameras.sh /dev/video0 /dev/video2 --calibration cameras.yml --depth 10
#
# Without a calibration the cameras must be rectified, so that a point is on the same row in both
# images. They must expose at the same time (external trigger): mtstereo pairs frames whose time
# stamps differ by less than half a frame period and drops the others.
#
# Options:
#   --size WxH          requested image size (default 640x480)
#   --rate N            requested frames per second (default 30)
set -euo pipefail
# shellcheck source=pipelines/common.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

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
[ ${#arguments[@]} -eq 2 ] || wrong_usage "two cameras are required, such as /dev/video0 /dev/video2"
[[ $size =~ ^([0-9]+)x([0-9]+)$ ]] || wrong_usage "--size is '$size'; expected WIDTHxHEIGHT, such as 640x480"
wanted="width=${BASH_REMATCH[1]},height=${BASH_REMATCH[2]}"
is_number "$rate" || wrong_usage "--rate is '$rate'; it must be an integer"
wanted+=",framerate=$rate/1"
if [ "$dry_run" = no ]; then
  for camera in "${arguments[@]}"; do
    [ -c "$camera" ] || fail "no such camera: $camera"
  done
fi

# Raw video or MJPEG, whichever the camera has at this size; decodebin passes raw video through.
caps="video/x-raw,$wanted;image/jpeg,$wanted"
mapfile -t left < <(view_to left)
mapfile -t right < <(view_to right)
mapfile -t output < <(output_of)
launch \
  v4l2src "device=${arguments[0]}" '!' "$caps" '!' decodebin '!' videoconvert "${left[@]}" \
  v4l2src "device=${arguments[1]}" '!' "$caps" '!' decodebin '!' videoconvert "${right[@]}" \
  "${matcher[@]}" "${output[@]}"
