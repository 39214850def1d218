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

# Makes the prefix `emulated`: programs of 64-bit ARM that a command with it starts run in the qemu-aarch64 of their
# room. The rule for them is one of a namespace of users, so nobody else is affected. The process `keeper` keeps it.
emulated=() keeper=
start_emulation() {
  local header='\x7fELF\x02\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\xb7\x00'
  local mask='\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff'
  mkdir "$work/rules"
  unshare --user --mount sleep infinity 2>/dev/null &
  keeper=$!
  while [ "$(readlink "/proc/$keeper/ns/user")" = "$(readlink /proc/self/ns/user)" ]; do sleep 0.1; done
  emulated=(nsenter --user --target "$keeper")
  # shellcheck disable=SC2016 # the variables are those of the inner shell
  { echo "0 0 65536" | tee "/proc/$keeper/gid_map" >"/proc/$keeper/uid_map"; } 2>/dev/null &&
    "${emulated[@]}" --mount sh -c 'mount -t binfmt_misc none "$1" && printf %s "$2" >"$1/register"' sh \
      "$work/rules" ":arm64:M::$header:$mask:/usr/bin/qemu-aarch64:"
}

# in_room NAME COMMAND...: with the prefix `enter`. A service that a package would start is not started.
enter=()
in_room() {
  local name=$1
  shift
  "${enter[@]}" chroot "$work/$name" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
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
  [ -z "$keeper" ] || kill "$keeper" 2>/dev/null || true
  # Ours, and those of an mmdebstrap that was interrupted.
  while read -r folder; do
    umount --lazy "$folder"
  done < <(awk -v below="$work/" 'index($2, below) == 1 { print $2 }' /proc/mounts | sort -r)
  rm -rf --one-file-system "$work"
}
