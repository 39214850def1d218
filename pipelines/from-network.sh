#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# from-network.sh [ADDRESS]: computes the disparity of two videos that another computer captures.
#
#   ./pipelines/from-network.sh                            (SRT, waits for a sender on port 7001)
#   ./pipelines/from-network.sh srt://:7001                (the same)
#   ./pipelines/from-network.sh srt://192.168.1.30:7001    (SRT, connects to a sender that waits)
#   ./pipelines/from-network.sh rtp://:5000                (RTP with RTCP on the ports 5000 to 5003)
#   ./pipelines/from-network.sh rtsp://a/left rtsp://b/right
#
# The sender is network-sender.sh, which sends files or cameras. With SRT both videos are in one
# stream, so their time stamps keep the difference that they have at the sender; lost packets are sent
# again. With RTP each frame carries the time of the sender's clock, by which frames are paired.
# Frames with lost packets are dropped. docs/network.md compares the two, and describes latency,
# encryption and firewalls.
#
# RTSP cameras are paired by the times of their RTCP reports: their clocks must be synchronized.
#
# Options:
#   --latency MS        time for packets that are late or sent again (default: srt 1000, rtp and rtsp 200)
#   --passphrase TEXT   decrypt SRT with this text of 10 to 79 characters, the same as at the sender
set -euo pipefail
# shellcheck source=pipelines/common.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"
# shellcheck source=pipelines/network.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/network.sh"

latency=
# shellcheck disable=SC2034  # common.sh reads it
status_of_limit=137 # an interrupt does not end a receiver that has had no sender, so it is killed
own_option() {
  case $1 in
    --latency) latency=$2 ;;
    --passphrase) passphrase=$2 ;;
    *) return 1 ;;
  esac
}
parse_options "$@"
[ ${#arguments[@]} -gt 0 ] || arguments=(srt://:7001)
[ -z "$latency" ] || is_number "$latency" || wrong_usage "--latency is '$latency'; it must be an integer [ms]"
check_passphrase "${arguments[0]}"

# A picture that cannot be decoded completely would show parts of an older one: it is dropped.
decode=('!' avdec_h264 output-corrupt=false discard-corrupted-frames=true '!' videoconvert)
# The depayloader collects whole pictures: a parser downstream of it would assign the time of the next
# picture to one whose last packet is lost. It keeps the start of a picture that is lost, with its time, and
# puts it in front of the next one, whose own start may be lost too: the first picture after a gap is dropped.
depay=('!' rtph264depay wait-for-keyframe=true '!' 'video/x-h264,stream-format=avc,alignment=au' '!'
  identity drop-buffer-flags=discont)
mapfile -t left_view < <(view_to left)
mapfile -t right_view < <(view_to right)
mapfile -t output < <(output_of)

# pair_by MODE: the default of sync-mode, which --set replaces.
pair_by() {
  matcher=("${matcher[@]:0:2}" "sync-mode=$1" "${matcher[@]:2}")
}

# Both videos in one MPEG-TS: the PID says which one is the left one. h264parse marks pictures whose end it
# has seen; mtwhole drops the others. A stream that ends before the demultiplexer has pads would not end
# the pipeline: typefind reports it as an error, in a branch of its own, since it removes the flags of gaps.
from_srt() {
  read_address "$1"
  local mode=caller
  [ -n "$host" ] || mode=listener
  launch \
    srtsrc "uri=srt://$host:$port" "mode=$mode" "latency=${latency:-1000}" "${encryption[@]}" '!' \
    tee name=received \
    received. '!' typefind '!' fakesink sync=false async=false \
    received. '!' tsdemux name=net latency=100 \
    net.video_0_0041 '!' queue '!' h264parse '!' mtwhole "${decode[@]}" "${left_view[@]}" \
    net.video_0_0042 '!' queue '!' h264parse '!' mtwhole "${decode[@]}" "${right_view[@]}" \
    "${matcher[@]}" "${output[@]}"
}

# receiver_of SESSION: the sockets of one session of rtpbin.
receiver_of() {
  local first=$((port + 2 * $1))
  printf '%s\n' udpsrc "port=$first" ${host:+"address=$host"} buffer-size=2000000 "caps=$rtp_caps" '!' \
    "net.recv_rtp_sink_$1" \
    udpsrc "port=$((first + 1))" ${host:+"address=$host"} caps=application/x-rtcp '!' \
    "net.recv_rtcp_sink_$1"
}

# One session of rtpbin for each video. The name of a pad is session, SSRC and payload type.
from_rtp() {
  read_address "$1"
  check_rtp_port
  local left right
  mapfile -t left < <(receiver_of 0)
  mapfile -t right < <(receiver_of 1)
  pair_by reference-timestamp
  launch \
    rtpbin name=net "latency=${latency:-200}" add-reference-timestamp-meta=true \
    "${left[@]}" "${right[@]}" \
    net.recv_rtp_src_0_1_96 "${depay[@]}" "${decode[@]}" "${left_view[@]}" \
    net.recv_rtp_src_1_2_96 "${depay[@]}" "${decode[@]}" "${right_view[@]}" \
    "${matcher[@]}" "${output[@]}"
}

from_rtsp() {
  local source=(latency="${latency:-200}" add-reference-timestamp-meta=true "${depay[@]}")
  pair_by reference-timestamp
  launch \
    rtspsrc "location=$1" "${source[@]}" "${decode[@]}" "${left_view[@]}" \
    rtspsrc "location=$2" "${source[@]}" "${decode[@]}" "${right_view[@]}" \
    "${matcher[@]}" "${output[@]}"
}

case "${#arguments[@]} ${arguments[*]}" in
  '1 srt://'*) from_srt "${arguments[0]}" ;;
  '1 rtp://'*) from_rtp "${arguments[0]}" ;;
  '2 rtsp://'*' rtsp://'* | '2 rtsps://'*' rtsps://'*) from_rtsp "${arguments[@]}" ;;
  '2 '[0-9]*) wrong_usage "two UDP ports without RTCP do not show which frames belong together:" \
    "use rtp://:${arguments[0]}, or srt://:7001" ;;
  *) wrong_usage "srt://[HOST]:PORT, rtp://[ADDRESS]:PORT or two rtsp:// addresses are required, not" \
    "'${arguments[*]}'" ;;
esac
