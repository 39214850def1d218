#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# from-files.sh LEFT RIGHT: computes the disparity of two video files.
#
#   ./pipelines/from-files.sh left.mp4 right.mp4
#   ./pipelines/from-files.sh left.mp4 right.mp4 --out disparity.mkv
#   ./pipelines/from-files.sh raw-left.mp4 raw-right.mp4 --calibration cameras.yml --depth 20
#
# Both videos must have the same size, and be rectified unless there is a calibration. Frames are
# paired by their time stamps, so both files must start at the same time.
set -euo pipefail
# shellcheck source=pipelines/common.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"
parse_options "$@"
[ ${#arguments[@]} -eq 2 ] || wrong_usage "two files are required, LEFT and RIGHT"
for file in "${arguments[@]}"; do require_file "$file"; done

mapfile -t left < <(view_to left)
mapfile -t right < <(view_to right)
mapfile -t output < <(output_of)
launch \
  filesrc "location=${arguments[0]}" '!' decodebin '!' videoconvert "${left[@]}" \
  filesrc "location=${arguments[1]}" '!' decodebin '!' videoconvert "${right[@]}" \
  "${matcher[@]}" "${output[@]}"
