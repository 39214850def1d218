#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# network-sender.sh LEFT RIGHT: sends two video files to from-network.sh: RTP with H.264, each on its
# own UDP port, in real time.
#
#   ./pipelines/network-sender.sh left.mp4 right.mp4
#   ./pipelines/network-sender.sh left.mp4 right.mp4 --host 192.168.1.20 --ports 5000,5002
#
# Options of this script (of the common ones below, only --seconds, --build and --dry-run apply):
#   --host NAME         receiver (default 127.0.0.1)
#   --ports L,R         UDP ports of the receiver (default 5000,5002)
set -euo pipefail
# shellcheck source=pipelines/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

host=127.0.0.1
ports=5000,5002
own_option() {
  case $1 in
    --host) host=$2 ;;
    --ports) ports=$2 ;;
    *) return 1 ;;
  esac
}
parse_options "$@"
[ ${#arguments[@]} -eq 2 ] || wrong_usage "two files are required, LEFT and RIGHT"
[[ $ports =~ ^([0-9]+),([0-9]+)$ ]] || wrong_usage "--ports is '$ports'; expected two ports, such as 5000,5002"
port_left=${BASH_REMATCH[1]} port_right=${BASH_REMATCH[2]}
for file in "${arguments[@]}"; do require_file "$file"; done

# Key frames and parameter sets are sent about once a second, so that a receiver can start at any
# time.
encode=('!' decodebin '!' videoconvert '!' 'video/x-raw,format=I420' '!'
  x264enc tune=zerolatency speed-preset=superfast bitrate=8000 key-int-max=30 '!'
  rtph264pay config-interval=1 '!' queue)
launch \
  filesrc "location=${arguments[0]}" "${encode[@]}" '!' udpsink "host=$host" "port=$port_left" \
  filesrc "location=${arguments[1]}" "${encode[@]}" '!' udpsink "host=$host" "port=$port_right"
