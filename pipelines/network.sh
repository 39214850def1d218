# SPDX-License-Identifier: LGPL-2.1-or-later
# shellcheck shell=bash
# What from-network.sh and network-sender.sh must agree on. Sourced only.

# shellcheck disable=SC2034  # the variables are read by the scripts that source this file
passphrase=
encryption=()

# The payload type and the header extension with the sender's time (RFC 6051).
rtp_extension='extmap-1=(string)urn:ietf:params:rtp-hdrext:ntp-64'
rtp_caps="application/x-rtp,media=video,clock-rate=90000,encoding-name=H264,payload=96,$rtp_extension"

# Splits srt://HOST:PORT or rtp://HOST:PORT into `host`, which may be empty, and `port`.
read_address() {
  [[ $1 =~ ^[a-z]+://([A-Za-z0-9_.-]*|\[[0-9A-Fa-f:.]+\]):([0-9]{1,5})$ ]] ||
    wrong_usage "the address is '$1'; expected ${1%%:*}://HOST:PORT, such as ${1%%:*}://192.168.1.20:7001"
  host=${BASH_REMATCH[1]} port=${BASH_REMATCH[2]}
  { [ "$port" -ge 1 ] && [ "$port" -le 65535 ]; } || wrong_usage "a port must be 1 to 65535, not $port"
}

# RTP and RTCP of two sessions take four ports.
check_rtp_port() {
  [ "$port" -le 65532 ] || wrong_usage "rtp:// takes four ports from PORT on, which must be at most 65532"
}

# check_passphrase ADDRESS: fills `encryption` with the properties of srtsrc and srtsink.
check_passphrase() {
  [ -n "$passphrase" ] || return 0
  [[ $1 == srt://* ]] || wrong_usage "--passphrase is for srt:// only, $1 is not encrypted"
  [[ $passphrase =~ ^[A-Za-z0-9_.,:+/=-]{10,79}$ ]] ||
    wrong_usage "--passphrase needs 10 to 79 characters out of A-Z, a-z, 0-9 and _.,:+/=-"
  encryption=("passphrase=$passphrase" pbkeylen=32)
}
