#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# from-png.sh LEFT RIGHT DISPARITY: computes the disparity of two numbered sequences of PNG images.
#
#   ./pipelines/from-png.sh left/%06d.png right/%06d.png disparity/%06d.png
#
# The output is 16-bit PNG images in KITTI's format: px = value / 256, 0 = no disparity; with
# --depth, it is millimeters. The folder of the result is created if missing. Without DISPARITY, the
# color images are shown.
#
# Options:
#   --first N           number of the first image (default 0)
#   --rate N            frames per second of the sequences (default 24)
set -euo pipefail
# shellcheck source=pipelines/common.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

first=0
rate=24
own_option() {
  case $1 in
    --first) first=$2 ;;
    --rate) rate=$2 ;;
    *) return 1 ;;
  esac
}
parse_options "$@"
case ${#arguments[@]} in
  2 | 3) ;;
  *) wrong_usage "two patterns such as left/%06d.png right/%06d.png are required; a third for the result is optional" ;;
esac
is_number "$first" || wrong_usage "--first is '$first'; it must be an integer"
is_number "$rate" || wrong_usage "--rate is '$rate'; it must be an integer"
for pattern in "${arguments[@]}"; do
  [[ $pattern =~ ^[^%]*%(0[0-9]+)?d[^%]*$ ]] ||
    wrong_usage "'$pattern' has no placeholder for the number; expected a pattern such as left/%06d.png"
done
if [ "$dry_run" = no ]; then
  for pattern in "${arguments[@]:0:2}"; do
    # shellcheck disable=SC2059  # the pattern is the format: it was checked above
    require_file "$(printf "$pattern" "$first")"
  done
fi

mapfile -t left < <(view_to left)
mapfile -t right < <(view_to right)
if [ ${#arguments[@]} -eq 3 ]; then
  out=${arguments[2]}
  [ "$dry_run" = yes ] || mkdir -p "$(dirname "$out")"
fi
mapfile -t output < <(output_of)
[ ${#arguments[@]} -eq 2 ] || output+=("index=$first")
reader=("index=$first" "caps=image/png,framerate=$rate/1" '!' pngdec '!' videoconvert)
launch \
  multifilesrc "location=${arguments[0]}" "${reader[@]}" "${left[@]}" \
  multifilesrc "location=${arguments[1]}" "${reader[@]}" "${right[@]}" \
  "${matcher[@]}" "${output[@]}"
