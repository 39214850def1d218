#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# network-sender.sh LEFT RIGHT: sends two cameras, or two video files in real time, to from-network.sh.
#
#   ./pipelines/network-sender.sh /dev/video0 /dev/video2 --to srt://192.168.1.20:7001
#   ./pipelines/network-sender.sh left.mp4 right.mp4 --to srt://192.168.1.20:7001
#   ./pipelines/network-sender.sh left.mp4 right.mp4 --to srt://:7001      (waits for the receiver)
#   ./pipelines/network-sender.sh left.mp4 right.mp4 --to rtp://192.168.1.20:5000
#
# SRT sends both videos in one MPEG-TS, the left one with the PID 65 and the right one with 66. RTP
# sends each in a session of its own, with RTCP and the time of this computer's clock in each frame.
# Every picture is H.264 that is decoded without any other one, so that a lost packet costs one frame.
#
# Options of this script (of the common ones below, those of matching and of the result have no effect):
#   --to ADDRESS        srt://[HOST]:PORT or rtp://HOST:PORT (default srt://127.0.0.1:7001)
#   --bitrate N         of each video [kbit/s] (default 8000)
#   --size WxH          requested image size of cameras (default 640x480)
#   --rate N            requested frames per second of cameras (default 30)
#   --latency MS        SRT: least time for packets that are sent again (default 125); the larger value
#                       of sender and receiver applies
#   --passphrase TEXT   encrypt SRT (AES-256) with this text of 10 to 79 characters
set -euo pipefail
# shellcheck source=pipelines/common.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"
# shellcheck source=pipelines/network.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/network.sh"

to=srt://127.0.0.1:7001
bitrate=8000
size=640x480
rate=30
latency=125
own_option() {
  case $1 in
    --to) to=$2 ;;
    --bitrate) bitrate=$2 ;;
    --size) size=$2 ;;
    --rate) rate=$2 ;;
    --latency) latency=$2 ;;
    --passphrase) passphrase=$2 ;;
    *) return 1 ;;
  esac
}
parse_options "$@"
[ ${#arguments[@]} -eq 2 ] || wrong_usage "two cameras or two files are required, LEFT and RIGHT"
[[ $to == srt://* || $to == rtp://[!:]* ]] ||
  wrong_usage "--to is '$to'; expected srt://[HOST]:PORT or rtp://HOST:PORT"
read_address "$to"
{ is_number "$bitrate" && [ "$bitrate" -ge 100 ]; } ||
  wrong_usage "--bitrate is '$bitrate'; it must be an integer from 100 on [kbit/s]"
[[ $size =~ ^([0-9]+)x([0-9]+)$ ]] || wrong_usage "--size is '$size'; expected WIDTHxHEIGHT, such as 640x480"
wanted="width=${BASH_REMATCH[1]},height=${BASH_REMATCH[2]}"
is_number "$rate" || wrong_usage "--rate is '$rate'; it must be an integer"
wanted+=",framerate=$rate/1"
is_number "$latency" || wrong_usage "--latency is '$latency'; it must be an integer [ms]"
check_passphrase "$to"
if [ "$dry_run" = no ]; then
  for input in "${arguments[@]}"; do
    if [[ $input == /dev/* ]]; then
      [ -c "$input" ] || fail "no such camera: $input"
    else
      require_file "$input"
    fi
  done
fi

# The frames of a camera or a file, at the times at which they are to be sent. A camera gives raw
# video or MJPEG, whichever it has at this size; decodebin passes raw video through.
frames_of() {
  local raw=('!' decodebin '!' videoconvert '!' 'video/x-raw,format=I420')
  if [[ $1 == /dev/* ]]; then
    printf '%s\n' v4l2src "device=$1" '!' "video/x-raw,$wanted;image/jpeg,$wanted" "${raw[@]}"
  else
    printf '%s\n' filesrc "location=$1" "${raw[@]}" '!' identity sync=true
  fi
}

# One slice per picture: a lost packet is a lost picture and never a part of one.
encode=('!' queue '!'
  x264enc tune=zerolatency sliced-threads=false threads=1 speed-preset=superfast "bitrate=$bitrate"
  key-int-max=1 '!' 'video/x-h264,profile=high' '!' h264parse config-interval=-1)

to_srt() {
  local mode=caller
  [ -n "$host" ] || mode=listener
  launch \
    mpegtsmux name=net alignment=7 '!' \
    srtsink "uri=srt://$host:$port" "mode=$mode" "latency=$latency" "${encryption[@]}" sync=false auto-reconnect=false \
    "${left[@]}" "${encode[@]}" '!' queue '!' net.sink_65 \
    "${right[@]}" "${encode[@]}" '!' queue '!' net.sink_66
}

# session_of NUMBER: one session of rtpbin, its sockets included. The times in RTCP and in the header
# extension are those of the capture: those of sending would differ between the videos. rtpsession ends
# RTCP with the video only if the last RTCP packet leaves after the end of the video has been handled, which
# the sleep [us] ensures.
session_of() {
  local first=$((port + 2 * $1))
  printf '%s\n' '!' rtph264pay "ssrc=$(($1 + 1))" pt=96 aggregate-mode=zero-latency '!' \
    "application/x-rtp,$rtp_extension" '!' "net.send_rtp_sink_$1" \
    "net.send_rtp_src_$1" '!' queue '!' udpsink "host=$host" "port=$first" sync=false async=false \
    "net.send_rtcp_src_$1" '!' identity sleep-time=20000 '!' udpsink "host=$host" "port=$((first + 1))" sync=false async=false
}

# The clock of the pipeline gives the times. The clock of the computer would be read separately for each
# packet, which is inexact if the computer is busy.
to_rtp() {
  check_rtp_port
  local left_session right_session
  mapfile -t left_session < <(session_of 0)
  mapfile -t right_session < <(session_of 1)
  launch \
    rtpbin name=net ntp-time-source=clock-time rtcp-sync-send-time=false \
    "${left[@]}" "${encode[@]}" "${left_session[@]}" \
    "${right[@]}" "${encode[@]}" "${right_session[@]}"
}

mapfile -t left < <(frames_of "${arguments[0]}")
mapfile -t right < <(frames_of "${arguments[1]}")
if [[ $to == srt://* ]]; then to_srt; else to_rtp; fi
