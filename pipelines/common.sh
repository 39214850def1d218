# SPDX-License-Identifier: LGPL-2.1-or-later
# shellcheck shell=bash
# Common parts of the pipeline scripts: options and the run itself. Sourced only.

# shellcheck disable=SC2034  # the variables are read by the scripts that source this file
dry_run=no
seconds=
out=
sink='videoconvert ! autovideosink'
matcher=(mtstereo name=m)
color=(mtcolor)
calibration=
alpha=
rectified_size=
far=
cloud=
arguments=()
status_of_limit=124 # of timeout, if --seconds are over

# shellcheck source=pipelines/plugin.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/plugin.sh"

fail() {
  echo "$(basename "$0"): $*" >&2
  exit 1
}

wrong_usage() {
  echo "$(basename "$0"): $* (see --help)" >&2
  exit 2
}

# Prints the comment at the top of the calling script as its help.
show_help() {
  sed -n -e '1,2d' -e '/^#/!q' -e 's/^# \{0,1\}//p' "$0" | with_command_names
  cat <<'END'

Options of every pipeline script:
  --calibration FILE  rectify the views of these cameras first, and take f and the baseline from it
  --alpha A           of the rectification: 0 = only what both cameras see (the default), 1 = all
                      pixels of both, between = between, -1 = the focal length of the cameras
  --rectified-size WxH  size of the rectified views [px]
  --depth METERS      output depths up to this distance, in millimeters, instead of disparities
  --cloud PATTERN     also write the points of each map, such as clouds/%05d.ply (needs --calibration)
  --out FILE.mkv      record the disparity or the depth losslessly instead of showing it; a pattern
                      such as depth/%06d.png writes 16-bit images
  --mode MODE         sparse, semi-dense, dense or full
  --max-disparity N   search range [px]
  --set NAME=VALUE    any other property of mtstereo (gst-inspect-1.0 mtstereo lists them)
  --sink ELEMENT      sink for the color video instead of autovideosink
  --seconds N         stop after N seconds
END
  plugin_help
  cat <<'END'
  --dry-run           print the gst-launch-1.0 command without running it
END
  exit 0
}

require_value() {
  [ $# -ge 2 ] || wrong_usage "$1 needs a value"
}

is_number() {
  [[ $1 =~ ^[0-9]{1,9}$ ]]
}

# Replaced by scripts with options of their own.
own_option() {
  return 1
}

# Parses the command line. Arguments other than options go to `arguments`. Options that only the
# calling script has are passed to its function own_option OPTION VALUE, whose status states whether
# the option exists (each of them takes a value).
parse_options() {
  while [ $# -gt 0 ]; do
    case $1 in
      --help | -h) show_help ;;
      --dry-run) dry_run=yes ;;
      --calibration | --alpha | --rectified-size | --depth | --cloud | --out | --mode | --max-disparity | --set | --sink | --seconds)
        require_value "$@"
        common_option "$1" "$2"
        shift
        ;;
      --*)
        plugin_option "$1" "${2-}" || own_option "$1" "${2-}" || wrong_usage "unknown option $1"
        require_value "$@"
        shift
        ;;
      *) arguments+=("$1") ;;
    esac
    shift
  done
  if [[ -z $calibration && -n $far$cloud ]]; then
    wrong_usage "--depth and --cloud need --calibration: without it the focal length and the baseline are unknown"
  fi
  if [[ -z $calibration && -n $alpha$rectified_size ]]; then
    wrong_usage "--alpha and --rectified-size need --calibration: without it nothing is rectified"
  fi
  [ "$dry_run" = yes ] || [ -z "$calibration" ] || require_calibration
  local input
  for input in "${arguments[@]}"; do
    [[ -z $out || ! $out -ef $input ]] || fail "--out $out is the input itself: choose another file"
  done
}

common_option() {
  case $1 in
    --calibration) calibration=$2 ;;
    --alpha)
      [[ $2 =~ ^(0(\.[0-9]+)?|1(\.0+)?|-1)$ ]] || wrong_usage "--alpha is '$2'; it must be 0 to 1, or -1"
      alpha=$2
      ;;
    --rectified-size)
      [[ $2 =~ ^[0-9]{1,5}x[0-9]{1,5}$ ]] ||
        wrong_usage "--rectified-size is '$2'; expected WIDTHxHEIGHT, such as 640x480"
      rectified_size=$2
      ;;
    --depth)
      [[ $2 =~ ^[0-9]+(\.[0-9]+)?$ && $2 =~ [1-9] ]] ||
        wrong_usage "--depth is '$2'; it must be a distance in meters, such as 20"
      far=$2
      color+=("far=$far")
      ;;
    --cloud)
      [[ $2 =~ \.(ply|pcd)$ ]] ||
        wrong_usage "--cloud is '$2'; expected a .ply or .pcd file, such as clouds/%05d.ply"
      cloud=$2
      ;;
    --out) out=$2 ;;
    --mode)
      [[ $2 == sparse || $2 == semi-dense || $2 == dense || $2 == full ]] ||
        wrong_usage "--mode is '$2'; it must be sparse, semi-dense, dense or full"
      matcher+=("mode=$2")
      ;;
    --max-disparity)
      { is_number "$2" && [ "$2" -ge 1 ] && [ "$2" -le 1984 ]; } ||
        wrong_usage "--max-disparity is '$2'; it must be an integer from 1 to 1984 [px]"
      matcher+=("max-disparity=$2")
      color+=("max-disparity=$2")
      ;;
    --set)
      [[ $2 == ?*=* ]] || wrong_usage "--set is '$2'; expected NAME=VALUE, such as threads=2"
      matcher+=("$2")
      ;;
    --sink) sink=$2 ;;
    --seconds)
      is_number "$2" || wrong_usage "--seconds is '$2'; it must be an integer"
      seconds=$2
      ;;
  esac
}

require_file() {
  [ -e "$1" ] || fail "no such file: $1"
  [ -r "$1" ] || fail "the file $1 cannot be read"
  [ ! -d "$1" ] || fail "$1 is a folder, not a video file"
}

# The element that reads a camera or a file.
source_of() {
  case $1 in
    /dev/*) printf '%s\n' v4l2src "device=$1" ;;
    *) printf '%s\n' filesrc "location=$1" ;;
  esac
}

# A file, or two of them separated by a comma.
require_calibration() {
  local file files
  [ ! -e "$calibration" ] || return 0
  IFS=, read -ra files <<<"$calibration"
  for file in "${files[@]}"; do
    [ -e "$file" ] || fail "there is no calibration $file: mtcalibrate makes one (docs/cameras.md)"
  done
}

# The elements from a decoded view to the matcher: view_to left.
view_to() {
  if [ -z "$calibration" ]; then
    printf '%s\n' '!' queue '!' "m.sink_$1"
    return
  fi
  local rectify=(mtrectify "camera=$1" "calibration=$calibration" ${alpha:+"alpha=$alpha"})
  [ -z "$rectified_size" ] || rectify+=("width=${rectified_size%x*}" "height=${rectified_size#*x}")
  if [[ -n $cloud && $1 == left ]]; then
    printf '%s\n' '!' "${rectify[@]}" color=true '!' tee name=view '!' queue '!' m.sink_left
  else
    printf '%s\n' '!' "${rectify[@]}" '!' queue '!' "m.sink_$1"
  fi
}

# The elements downstream of mtstereo: a color image on the screen, or a lossless file, and clouds.
output_of() {
  if [ -n "$cloud" ]; then
    printf '%s\n' '!' queue '!' tee name=maps '!' queue '!' mtcloud name=cloud "location=$cloud" \
      ${far:+"far=$far"} view. '!' queue '!' videoconvert '!' cloud.sink_left maps.
  fi
  [ -z "$far" ] || printf '%s\n' '!' queue '!' mtdepth "far=$far"
  if [[ $out == *.png ]]; then
    # Without the format, pngenc would get 8 bits.
    printf '%s\n' '!' queue '!' videoconvert '!' video/x-raw,format=GRAY16_BE '!' pngenc '!' \
      multifilesink "location=$out"
  elif [ -n "$out" ]; then
    printf '%s\n' '!' queue '!' avenc_ffv1 '!' matroskamux '!' filesink "location=$out"
  else
    local words
    read -ra words <<<"$sink"
    printf '%s\n' '!' queue '!' "${color[@]}" '!' "${words[@]}"
  fi
}

# A word in shell syntax, quoted if it has special characters.
quoted() {
  if [[ $1 =~ ^[A-Za-z0-9_./:=,%@+!-]+$ ]]; then
    printf ' %s' "$1"
  else
    printf " '%s'" "${1//\'/\'\\\'\'}"
  fi
}

# Fails if a file to be written, or one of a pattern, exists: nothing of the user is replaced.
refuse_existing() {
  local file files=("$1")
  [ -n "$1" ] || return 0
  if [[ $1 =~ ^([^%]*)%(0[0-9]+)?d([^%]*)$ ]]; then
    files=("${BASH_REMATCH[1]}"[0-9]*"${BASH_REMATCH[3]}")
  fi
  for file in "${files[@]}"; do
    [[ ! -e $file || -c $file ]] || fail "$file exists: move it, or choose another name"
  done
}

# Runs gst-launch-1.0, or prints the command. With -e an interrupt finishes the files properly.
launch() {
  local line=(gst-launch-1.0 -e "$@")
  if [ "$dry_run" = yes ]; then
    local word
    [ -z "$plugin_folder" ] || printf 'GST_PLUGIN_PATH=%q ' "$plugin_folder"
    printf '%s' "${line[0]}"
    for word in "${line[@]:1}"; do quoted "$word"; done
    printf '\n'
    return
  fi
  use_plugin
  local file status=0
  for file in "$out" "$cloud"; do refuse_existing "$file"; done
  # Without a display, autovideosink may choose a sink that crashes.
  if [[ " ${line[*]} " == *" autovideosink "* && -z ${DISPLAY:-}${WAYLAND_DISPLAY:-} && ! -e /dev/dri && ! -e /dev/fb0 ]]; then
    fail "there is no display: record with --out, or choose a sink with --sink"
  fi
  if [ -z "$seconds" ]; then
    "${line[@]}" || status=$?
  else
    # The interrupt after --seconds is not a failure.
    timeout --signal=INT --kill-after=10 "$seconds" "${line[@]}" || status=$?
    [ "$status" -ne 124 ] && [ "$status" -ne "$status_of_limit" ] || status=0
  fi
  # A pipeline that fails at its start has created an empty file.
  if [[ $status -ne 0 && -f $out && ! -s $out ]]; then rm -f -- "$out"; fi
  return "$status"
}
