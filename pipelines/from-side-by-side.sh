#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# from-side-by-side.sh SOURCE: computes the disparity of one stream with both views in each frame.
#
#   ./pipelines/from-side-by-side.sh side-by-side.mp4
#   ./pipelines/from-side-by-side.sh /dev/video0 --size 2560x720
#   ./pipelines/from-side-by-side.sh /dev/video0 --calibration cameras.yml --depth 10
#
# The left half is the left view. mtsplit makes two streams of the halves, without copying pixels.
# Both have the same time stamps, so every frame has its partner.
#
# Options:
#   --layout LAYOUT     side-by-side (default) or top-bottom
#   --size WxH          requested size of the whole image of a camera (default: 2560x720)
set -euo pipefail
# shellcheck source=pipelines/common.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

layout=side-by-side
size=2560x720
own_option() {
  case $1 in
    --layout) layout=$2 ;;
    --size) size=$2 ;;
    *) return 1 ;;
  esac
}
parse_options "$@"
[ ${#arguments[@]} -eq 1 ] || wrong_usage "one file or camera is required"
[[ $layout == side-by-side || $layout == top-bottom ]] ||
  wrong_usage "--layout is '$layout'; it must be side-by-side or top-bottom"
[[ $size =~ ^([0-9]+)x([0-9]+)$ ]] ||
  wrong_usage "--size is '$size'; expected WIDTHxHEIGHT, such as 2560x720"
wanted="width=${BASH_REMATCH[1]},height=${BASH_REMATCH[2]}"
input=${arguments[0]}
mapfile -t source < <(source_of "$input")
if [[ $input == /dev/* ]]; then
  [ "$dry_run" = yes ] || [ -c "$input" ] || fail "no such camera: $input"
  source+=('!' "video/x-raw,$wanted;image/jpeg,$wanted")
else
  [ "$dry_run" = yes ] || require_file "$input"
fi

mapfile -t left < <(view_to left)
mapfile -t right < <(view_to right)
mapfile -t output < <(output_of)
launch \
  "${source[@]}" '!' decodebin '!' videoconvert '!' mtsplit "layout=$layout" name=both \
  both.left "${left[@]}" \
  both.right "${right[@]}" \
  "${matcher[@]}" "${output[@]}"
