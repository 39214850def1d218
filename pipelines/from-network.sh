#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# from-network.sh LEFT RIGHT: computes the disparity of two H.264 streams from the network.
#
#   ./pipelines/from-network.sh 5000 5002                  (RTP on two UDP ports)
#   ./pipelines/from-network.sh rtsp://a/left rtsp://b/right
#
# To try it on one machine, start network-sender.sh in another terminal. RTP over UDP loses packets
# on a bad network; a frame without a partner is dropped and counted. The time stamps are those of
# the arrival: if one path is slower than the other by half a frame or more, set the difference by the
# property sink_right::offset, or use time stamps of the sender.
#
# Options:
#   --latency MS        waiting time for late packets (default 200)
#   --tolerance MS      largest difference of the time stamps of a pair (default half a frame)
set -euo pipefail
# shellcheck source=pipelines/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

latency=200
tolerance=
own_option() {
  case $1 in
    --latency) latency=$2 ;;
    --tolerance) tolerance=$2 ;;
    *) return 1 ;;
  esac
}
parse_options "$@"
[ ${#arguments[@]} -eq 2 ] || wrong_usage "two UDP ports or two rtsp:// addresses are required"
is_number "$latency" || wrong_usage "--latency is '$latency'; it must be an integer [ms]"
if [ -n "$tolerance" ]; then
  is_number "$tolerance" || wrong_usage "--tolerance is '$tolerance'; it must be an integer [ms]"
  matcher+=("sync-tolerance=$((tolerance * 1000000))")
fi

receiver_of() {
  if is_number "$1"; then
    if [ "$1" -lt 1 ] || [ "$1" -gt 65535 ]; then fail "a UDP port must be 1 to 65535, not $1"; fi
    printf '%s\n' udpsrc "port=$1" \
      "caps=application/x-rtp,media=video,clock-rate=90000,encoding-name=H264" \
      '!' rtpjitterbuffer "latency=$latency" '!' rtph264depay '!' h264parse
  elif [[ $1 == rtsp://* || $1 == rtsps://* ]]; then
    printf '%s\n' rtspsrc "location=$1" "latency=$latency" '!' rtph264depay '!' h264parse
  else
    fail "'$1' is neither a UDP port nor an rtsp:// address"
  fi
}

left=$(receiver_of "${arguments[0]}")
right=$(receiver_of "${arguments[1]}")
mapfile -t left <<<"$left"
mapfile -t right <<<"$right"
mapfile -t left_view < <(view_to left)
mapfile -t right_view < <(view_to right)
mapfile -t output < <(output_of)
launch \
  "${left[@]}" '!' avdec_h264 '!' videoconvert "${left_view[@]}" \
  "${right[@]}" '!' avdec_h264 '!' videoconvert "${right_view[@]}" \
  "${matcher[@]}" "${output[@]}"
