#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# run.sh [OPTION...]: builds the Debian packages in a minimal Debian 12, installs them in another one without packages
# for development, runs their tests (debian/tests), and removes them again. States how long each step takes.
#
# Options:
#   --packages DIR  test the packages in this folder, and build none
#   --out DIR       keep the packages that are built in this new folder
#   --twice         build a second time, in another folder with other settings, and compare the packages
#   --before DIR    install the packages of an earlier version, in this folder, first, and upgrade them
#   --arch arm64    packages for 64-bit ARM: cross-compiled, and started by QEMU
#   --if-asked      for `meson test`: is skipped (status 77) unless MTSTEREO_PACKAGES is set and the tools are there
#
# Needs root and the packages with the mark debian of pipelines/packages.txt. The mirror of Debian 12 is that of
# this machine's own sources of packages.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
repository=$(cd "$here/../.." && pwd)
# shellcheck source=tests/packages/rooms.sh
source "$here/rooms.sh"

arguments=("$@")
given='' out='' before='' arch='' twice=no skip_status=1
while [ $# -gt 0 ]; do
  case $1 in
    --packages | --out | --before | --arch)
      [ $# -ge 2 ] || { echo "run.sh: $1 needs a value" >&2 && exit 2; }
      case $1 in
        --arch) arch=$2 ;;
        --packages) given=$(realpath "$2") ;;
        --out) out=$(realpath -m "$2") ;;
        --before) before=$(realpath "$2") ;;
      esac
      shift
      ;;
    --twice) twice=yes ;;
    --if-asked)
      [ -n "${MTSTEREO_PACKAGES:-}" ] || { echo "skipped: MTSTEREO_PACKAGES is not set" && exit 77; }
      skip_status=77
      ;;
    --help | -h)
      sed -n -e '1,2d' -e '/^#/!q' -e 's/^# \{0,1\}//p' "$0"
      exit 0
      ;;
    *)
      echo "run.sh: there is no option $1 (--help lists them)" >&2
      exit 2
      ;;
  esac
  shift
done

[ -z "$out" ] || [ ! -e "$out" ] || { echo "run.sh: $out exists: name a folder that does not exist" >&2 && exit 2; }
for folder in "$given" "$before"; do
  [ -z "$folder" ] || compgen -G "$folder/*.deb" >/dev/null ||
    { echo "run.sh: there are no packages in $folder" >&2 && exit 2; }
done
missing=$(what_is_missing)
[ -z "$missing" ] || { echo "run.sh: not run: $missing" >&2 && exit "$skip_status"; }
build=(-b) room_options=() tools_to_build=() tools_to_use=()
if [ -n "$arch" ]; then
  [ "$arch" = arm64 ] || { echo "run.sh: --arch needs arm64, got '$arch'" >&2 && exit 2; }
  room_options=("--architectures=$(dpkg --print-architecture),$arch")
  build=(-B "-a$arch" "-Pcross,nocheck")
  tools_to_build=("--include=crossbuild-essential-$arch")
  tools_to_use=("--include=qemu-user,man-db")
fi
enter_own_mounts "${arguments[@]}"

work=$(mktemp -d)
chmod 755 "$work"
trap leave_rooms EXIT
[ -z "$arch" ] || start_emulation ||
  { echo "run.sh: not run: --arch needs binfmt_misc in namespaces of users, Linux 6.7" >&2 && exit "$skip_status"; }
# The files under version control, as they are now.
mkdir "$work/source"
git -C "$repository" ls-files -z | tar -C "$repository" --null -T - -c | tar -x -C "$work/source"

# The packages that debian/control names for the build, and no others.
install_build_dependencies() {
  mkdir "$work/build/control"
  cp -r "$work/source/debian" "$work/build/control"
  in_room build sh -c 'cd /control && apt-get build-dep -q -y --no-install-recommends "$@" ./' sh \
    ${arch:+"-a$arch" -Pcross,nocheck --arch-only} >"$work/build.log" 2>&1 || {
    tail -n 20 "$work/build.log"
    return 1
  }
}

# build_packages FOLDER [NAME=VALUE...]: builds in this folder of the room, with these variables.
build_packages() {
  local folder=$1
  shift
  mkdir -p "$work/build/$folder"
  cp -r "$work/source/." "$work/build/$folder"
  in_room build "DEB_BUILD_OPTIONS=nocheck parallel=$(nproc)" "$@" \
    sh -c "cd /$folder && dpkg-buildpackage -us -uc ${build[*]}" >"$work/build.log" 2>&1 || {
    tail -n 40 "$work/build.log" | cut -c1-500
    return 1
  }
}

compare_builds() {
  local package different=0
  for package in "$work"/build/first/*.deb; do
    if cmp -s "$package" "$work/build/second/other/${package##*/}"; then
      echo "reproducible: ${package##*/}"
    else
      echo "NOT reproducible: ${package##*/}"
      different=1
    fi
  done
  return "$different"
}

check_packages() {
  lintian --allow-root --fail-on error,warning "$packages"/*.deb
}

# install_packages FOLDER: installs those for use, not those with debug information and for development.
install_packages() {
  mkdir -p "$work/use/packages"
  cp "$1"/*.deb "$work/use/packages"
  local list
  mapfile -t list < <(find "$1" -name '*.deb' ! -name '*-dbgsym_*' ! -name '*-dev_*' -printf '/packages/%f\n')
  [ -z "$arch" ] || list+=("gstreamer1.0-tools:$arch")
  in_room use apt-get install -q -y --no-install-recommends "${list[@]}" >"$work/install.log" 2>&1 || {
    tail -n 20 "$work/install.log"
    return 1
  }
  ! in_room use dpkg --get-selections | grep -E -- '-dev(:|[[:space:]])' || {
    echo "packages for development are installed"
    return 1
  }
}

# upgrade_packages BEFORE FOLDER: installs an earlier version, and then this one. A package that this version does not
# have, such as a library with another soname, stays.
# shellcheck disable=SC2016 # the variables are those of dpkg-query
upgrade_packages() {
  local package version now
  install_packages "$1"
  in_room use dpkg-query -W -f '${Package} ${Version}\n' '*mtstereo*' >"$work/before"
  rm "$work"/use/packages/*
  install_packages "$2"
  while read -r package version; do
    now=$(in_room use dpkg-query -W -f '${db:Status-Status} ${Version}' "$package" 2>&1) || true
    [[ $now = "installed "* ]] || { echo "$package $version was removed: $now" && return 1; }
    now=${now#installed }
    if ! compgen -G "$2/${package}_*.deb" >/dev/null; then
      echo "stays: $package $version"
    elif dpkg --compare-versions "$now" gt "$version"; then
      echo "upgraded: $package $version to $now"
    else
      echo "$package had version $version, which this one does not replace"
      return 1
    fi
  done <"$work/before"
}

first_map() {
  in_room use gst-launch-1.0 -q videotestsrc pattern=snow num-buffers=1 ! \
    video/x-raw,width=328,height=240 ! tee name=n ! queue ! videocrop right=8 ! m.sink_left \
    n. ! queue ! videocrop left=8 ! m.sink_right \
    mtstereo name=m ! mtcolor ! videoconvert ! pngenc ! filesink location=/tmp/map.png
  [ -s "$work/use/tmp/map.png" ]
}

run_package_tests() {
  autopkgtest --no-built-binaries "$work"/use/packages/*.deb "$work/source" \
    --summary-file="$work/summary" --output-dir="$work/tests" -- chroot "$work/use" >"$work/tests.log" 2>&1 || {
    tail -n 60 "$work/tests.log"
    return 1
  }
  cat "$work/summary"
}

# The tests that need no packages for development. autopkgtest would look for packages of this machine's architecture.
start_programs() {
  local script
  cp -r "$work/source/debian/tests" "$work/use/tests"
  for script in plugin.sh tools.sh python.py; do
    mkdir "$work/use/tmp/$script"
    in_room use env "AUTOPKGTEST_TMP=/tmp/$script" "/tests/$script" >"$work/tests.log" 2>&1 || {
      tail -n 20 "$work/tests.log"
      echo "FAIL: $script"
      return 1
    }
    echo "PASS: $script"
  done
}

remove_packages() {
  in_room use apt-get purge -q -y '?installed?name(mtstereo)' >"$work/remove.log" 2>&1 || {
    tail -n 20 "$work/remove.log"
    return 1
  }
  local left
  left=$(find "$work/use" -xdev '(' -name '*mtstereo*' -o -name mtcalibrate ')' \
    ! -path "$work/use/packages/*" ! -path "$work/use/tmp/*" ! -path "$work/use/var/log/*")
  [ -z "$left" ] || { echo "left behind: $left"; return 1; }
}

if [ -n "$given" ]; then
  packages=$given
else
  step "a room to build in" make_room build --variant=buildd \
    "${room_options[@]}" "${tools_to_build[@]}"
  step "the packages that the build needs" install_build_dependencies
  step "building" build_packages first/source
  packages=$work/build/first
  if [ "$twice" = yes ]; then
    step "building again" build_packages second/other/folder TZ=Asia/Tokyo LC_ALL=POSIX
    step "comparing both builds" compare_builds
  fi
fi
[ -z "$out" ] || { mkdir -p "$out" && cp "$packages"/*.deb "$out"; }
stat -c '%s %n' "$packages"/*.deb | sed "s#$packages/##"
step "lintian" check_packages
step "a room to use them in" make_room use --variant=minbase "${room_options[@]}" "${tools_to_use[@]}"
enter=("${emulated[@]}")
if [ -n "$before" ]; then
  step "upgrading" upgrade_packages "$before" "$packages"
else
  step "installing" install_packages "$packages"
fi
step "the first map" first_map
if [ -n "$arch" ]; then
  step "the tests of the packages, by QEMU" start_programs
else
  step "the tests of the packages" run_package_tests
fi
step "removing" remove_packages
