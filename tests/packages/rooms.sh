# SPDX-License-Identifier: LGPL-2.1-or-later
# shellcheck shell=bash
# Minimal systems of Debian 12 in folders of $work, called rooms, and commands that run in them. Sourced by run.sh.
: "${work:=}"

# This machine's files with sources of Debian 12.
debian_sources() {
  grep -lEr --include='*.sources' --include='*.list' '(^|[[:space:]])bookworm([[:space:]]|$)' \
    /etc/apt/sources.list /etc/apt/sources.list.d 2>/dev/null
}

# Why there can be no rooms; prints nothing if there can.
what_is_missing() {
  local tool
  for tool in mmdebstrap autopkgtest lintian unshare; do
    [ -n "$(command -v "$tool")" ] || { echo "$tool is missing: ./pipelines/install-packages.sh debian" && return; }
  done
  [ "$(id -u)" -eq 0 ] || { echo "this needs root" && return; }
  [ -n "$(debian_sources)" ] || echo "no sources of packages of Debian 12 (bookworm) in /etc/apt"
}

# Starts the calling script again where nobody else sees what it mounts, and all of it is gone at its end.
enter_own_mounts() {
  [ -n "${MTSTEREO_OWN_MOUNTS:-}" ] || MTSTEREO_OWN_MOUNTS=yes exec unshare --mount --propagation private "$0" "$@"
}

# make_room NAME OPTION...: with options for mmdebstrap.
make_room() {
  local name=$1 sources
  shift
  mapfile -t sources < <(debian_sources)
  mmdebstrap --quiet --mode=root "$@" bookworm "$work/$name" "${sources[@]}" >"$work/$name.log" 2>&1 || {
    tail -n 20 "$work/$name.log"
    return 1
  }
  mount -t proc proc "$work/$name/proc"
  cp /etc/resolv.conf "$work/$name/etc/resolv.conf"
  in_room "$name" apt-get update -q >"$work/$name.log" 2>&1
}

# in_room NAME COMMAND...: a service that a package would start is not started.
in_room() {
  local name=$1
  shift
  chroot "$work/$name" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive ${http_proxy:+"http_proxy=$http_proxy"} "$@"
}

# step WHAT FUNCTION ARGUMENT...: runs a function and prints how long it took.
running=
step() {
  local start=$SECONDS
  running=$1
  shift
  echo "== $running"
  "$@"
  echo "   $((SECONDS - start)) s"
  running=
}

leave_rooms() {
  local folder
  [ -z "$running" ] || echo "FAILED: $running"
  # Ours, and those of an mmdebstrap that was interrupted.
  while read -r folder; do
    umount --lazy "$folder"
  done < <(awk -v below="$work/" 'index($2, below) == 1 { print $2 }' /proc/mounts | sort -r)
  rm -rf --one-file-system "$work"
}
