#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# demo.sh: the complete demo. Installs missing packages, builds, renders a stereo clip, encodes it to
# two H.264 files, runs mtstereo on them, and prints accuracy and speed.
# demo.sh --raw: the same with two cameras that are not rectified: renders views of a calibration
# board, calibrates the cameras, rectifies, matches, and prints the errors of the depths in meters.
# demo.sh LEFT RIGHT: the same with two rectified video files of your own (without ground truth).
#
# Options:
#   --out DIR           output folder (default out/): a new or empty one, or that of an earlier demo
#   --mode MODE         mode of the main result: sparse, semi-dense (default), dense or full
#   --max-disparity N   search range [px] (default: the clip's; the element's for your own files)
#   --frames N          number of frames of the rendered clip (default 48)
#   --size WxH          size of the rendered clip (default 640x360)
#   --scene NAME        street (default), garden or room
#   --raw               cameras with lens distortion, turned against each other
#   --alpha A           of the rectification with --raw: 0 = only what both cameras see (the default),
#                       1 = all pixels of both, between = between
#   --rectified-size WxH  size of the rectified views with --raw [px]
#   --soft              simple cameras: a soft lens, noise, processing, and H.264 with 1.5 Mbit/s for
#                       1280x720
#   --build DIR         build folder (default: build/, or $BUILD)
#   --no-build          use the build folder as it is; install and build nothing
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
repository=$(cd "$here/.." && pwd)
build=${BUILD:-$repository/build}
out=$repository/out
mode=semi-dense
max_disparity=
frames=48
size=640x360
scene=street
rate=24
build_first=yes
raw=no
alpha=
rectified_size=
soft=no
odd_width=0 odd_height=0 # of the disparity, see odd()
limit=900 # longest time of a pipeline [s]
files=()

fail() {
  echo "demo.sh: $*" >&2
  exit 1
}

wrong_usage() {
  echo "demo.sh: $* (see --help)" >&2
  exit 2
}

whole_number() {
  [[ $2 =~ ^[1-9][0-9]{0,5}$ ]] || wrong_usage "$1 is '$2'; it must be an integer above 0"
}

take_option() {
  case $1 in
    --out) out=$2 ;;
    --mode)
      [[ $2 == sparse || $2 == semi-dense || $2 == dense || $2 == full ]] ||
        wrong_usage "--mode is '$2'; it must be sparse, semi-dense, dense or full"
      mode=$2
      ;;
    --max-disparity)
      whole_number "$@"
      [ "$2" -le 1984 ] || wrong_usage "--max-disparity is '$2'; it must be 1 to 1984 [px]"
      max_disparity=$2
      ;;
    --frames) whole_number "$@" && frames=$2 ;;
    --size)
      [[ $2 =~ ^([1-9][0-9]{1,4})x([1-9][0-9]{1,4})$ ]] ||
        wrong_usage "--size is '$2'; expected WIDTHxHEIGHT, such as 640x360"
      if [ $((BASH_REMATCH[1] % 2 + BASH_REMATCH[2] % 2)) -ne 0 ]; then
        wrong_usage "--size is '$2'; H.264 needs an even width and height"
      fi
      size=$2
      ;;
    --scene) scene=$2 ;;
    --alpha)
      [[ $2 =~ ^(0(\.[0-9]+)?|1(\.0+)?)$ ]] || wrong_usage "--alpha is '$2'; it must be 0 to 1"
      alpha=$2
      ;;
    --rectified-size)
      [[ $2 =~ ^[1-9][0-9]{1,4}x[1-9][0-9]{1,4}$ ]] ||
        wrong_usage "--rectified-size is '$2'; expected WIDTHxHEIGHT, such as 640x360"
      rectified_size=$2
      ;;
    --build) build=$2 ;;
    *) wrong_usage "unknown option $1" ;;
  esac
}

while [ $# -gt 0 ]; do
  case $1 in
    --help | -h)
      sed -n -e '1,2d' -e '/^#/!q' -e 's/^# \{0,1\}//p' "$0"
      exit 0
      ;;
    --no-build) build_first=no ;;
    --raw) raw=yes ;;
    --soft) soft=yes ;;
    --*)
      [ $# -ge 2 ] || wrong_usage "$1 needs a value or is unknown"
      take_option "$1" "$2"
      shift
      ;;
    *) files+=("$1") ;;
  esac
  shift
done
if [[ $raw = no && -n $alpha$rectified_size ]]; then
  wrong_usage "--alpha and --rectified-size need --raw: other views are rectified already"
fi
case ${#files[@]} in
  0) ;;
  2)
    [ "$raw" = no ] || wrong_usage "--raw renders its own videos; for yours, see from-files.sh --calibration"
    [ "$soft" = no ] || wrong_usage "--soft renders its own videos"
    for file in "${files[@]}"; do
      [ -f "$file" ] || fail "no such file: $file"
      [ -r "$file" ] || fail "the file $file cannot be read"
    done
    ;;
  *) wrong_usage "two video files are required, LEFT and RIGHT, or none" ;;
esac

step() {
  echo "== $*"
}

# Runs a pipeline quietly; if it fails, prints its messages and exits.
log=
play() {
  local status=0
  timeout --kill-after=10 "$limit" gst-launch-1.0 "$@" >"$log" 2>&1 || status=$?
  [ "$status" -ne 0 ] || return 0
  grep -E -A3 '^ERROR|WARNING: erroneous|erroneous pipeline' "$log" >&2 || cat "$log" >&2
  [ "$status" -ne 124 ] || fail "the pipeline was stopped after $limit s"
  fail "the pipeline failed"
}

# The running time of the last pipeline [s], as printed by gst-launch-1.0.
played_seconds() {
  sed -n 's/^Execution ended after \([0-9]*\):\([0-9]*\):\([0-9.]*\)$/\1 \2 \3/p' "$log" |
    awk '{ print $1 * 3600 + $2 * 60 + $3 }'
}

build_all() {
  step "Packages and build ($build)"
  "$here/install-packages.sh"
  if [ ! -e "$build/build.ninja" ]; then
    meson setup "$build" "$repository" >"$log" 2>&1 || { cat "$log" >&2 && fail "meson failed"; }
  fi
  ninja -C "$build" gst/libgstmtstereo.so pipelines/tools/render/mtstereo-render \
    pipelines/tools/compare/mtstereo-compare pipelines/programs/calibrate/mtcalibrate >"$log" 2>&1 || { cat "$log" >&2 && fail "the build failed"; }
}

# Further arguments are options of mtstereo-render.
render_clip() {
  local side camera=() encoder=(pass=quant quantizer=10 speed-preset=medium)
  if [ "$soft" = yes ]; then
    camera=(--blur 0.7 --rim-blur 1 --noise 2 --shot-noise 0.05 --mosaic)
    # What encoders in cameras do: a constant rate of bits, no bidirectional frames, little effort.
    encoder=("bitrate=$(((1500 * ${size%x*} * ${size#*x} + 1280 * 720 - 1) / (1280 * 720)))" bframes=0
      speed-preset=veryfast)
  fi
  step "Rendering $frames frames of the $scene, $size"
  "$build/pipelines/tools/render/mtstereo-render" "$out/clip" --overwrite --scene "$scene" \
    --frames "$frames" --size "$size" --rate "$rate" "${camera[@]}" "$@" ||
    fail "the clip could not be rendered"
  for side in left right; do
    step "Encoding $out/$side.mp4 (H.264)"
    play multifilesrc "location=$out/clip/$side/%06d.png" "caps=image/png,framerate=$rate/1" '!' \
      pngdec '!' videoconvert '!' video/x-raw,format=I420 '!' \
      x264enc "${encoder[@]}" key-int-max="$rate" '!' \
      h264parse '!' mp4mux '!' filesink "location=$out/$side.mp4"
  done
  files=("$out/left.mp4" "$out/right.mp4")
  if [ -z "$max_disparity" ]; then
    max_disparity=$(sed -n 's/^ndisp=//p' "$out/clip/calib.txt")
  fi
}

# Two video files -> lossless disparity. Prints mtstereo's messages about invalid input. The watchdog
# stops a pipeline without output for a minute.
match() {
  local matcher=(mtstereo name=m "mode=$1")
  [ -z "$max_disparity" ] || matcher+=("max-disparity=$max_disparity")
  play -v \
    filesrc "location=${files[0]}" '!' decodebin '!' videoconvert '!' queue '!' m.sink_left \
    filesrc "location=${files[1]}" '!' decodebin '!' videoconvert '!' queue '!' m.sink_right \
    "${matcher[@]}" '!' watchdog timeout=60000 '!' queue '!' avenc_ffv1 '!' matroskamux '!' \
    filesink "location=$out/disparity-$1.mkv"
  odd_width=$(odd width) odd_height=$(odd height)
}

# 1 if the width (height) of the disparity in the output of gst-launch-1.0 -v is odd, else 0.
odd() {
  local value
  value=$(sed -n "s/.*GstMtStereo:m.GstAggregatorPad:src: caps = .* $1=(int)\\([0-9]*\\).*/\\1/p" "$log" |
    head -n 1)
  echo $((${value:-0} % 2))
}

# Lossless disparity -> 16-bit PNG images, px = value / 256. Further arguments are properties of
# pngenc, such as snapshot=true for the first frame only.
to_images() {
  rm -rf "$out/disparity-$1"
  mkdir -p "$out/disparity-$1"
  play filesrc "location=$out/disparity-$1.mkv" '!' matroskademux '!' avdec_ffv1 '!' \
    videoconvert '!' video/x-raw,format=GRAY16_BE '!' pngenc "${@:2}" '!' \
    multifilesink "location=$out/disparity-$1/%06d.png"
}

# H.264 in the usual 4:2:0 needs even sizes, so an odd image loses its last column or row.
to_color() {
  local color=(mtcolor)
  [ -z "$max_disparity" ] || color+=("max-disparity=$max_disparity")
  play filesrc "location=$out/disparity-$mode.mkv" '!' matroskademux '!' avdec_ffv1 '!' \
    "${color[@]}" '!' videocrop "right=$odd_width" "bottom=$odd_height" '!' \
    videoconvert '!' video/x-raw,format=I420 '!' x264enc pass=quant quantizer=18 '!' h264parse '!' mp4mux '!' filesink "location=$out/color.mp4"
}

compare() {
  "$build/pipelines/tools/compare/mtstereo-compare" "$@" || fail "the comparison failed"
}

demo_of_clip() {
  local table=() m seconds speed row
  render_clip
  for m in sparse semi-dense dense full; do
    step "Matching the two files, mode $m"
    match "$m"
    seconds=$(played_seconds)
    to_images "$m"
    row=$(compare --label "$m" --disparity "$out/disparity-$m" --truth "$out/clip/truth" \
      --mask "$out/clip/mask")
    speed=$(awk -v n="$frames" -v s="$seconds" 'BEGIN { printf("%.1f", (s > 0) ? n / s : 0) }')
    table+=("$row $(printf '%8s' "$speed")")
  done
  step "Color video and image"
  to_color
  compare --disparity "$out/disparity-$mode" --truth "$out/clip/truth" --left "$out/clip/left" \
    --picture "$out/demo.png" --width 1200 --frame $((frames / 2)) --max-disparity "$max_disparity" >/dev/null
  echo
  echo "Accuracy against the ground truth, mean over the clip; seen = pixels visible in both views."
  echo "fps = frames per second from the two H.264 files to the disparity file, $(nproc) processors."
  printf '%-12s %6s %10s %9s %10s %14s %13s %8s\n' mode frames 'avgerr px' 'D-all %' 'density %' \
    'seen avgerr px' 'seen D-all %' fps
  printf '%s\n' "${table[@]}"
}

demo_of_files() {
  limit=86400
  step "Matching the two files, mode $mode"
  match "$mode"
  step "Color video and image"
  to_color
  to_images "$mode" snapshot=true
  play filesrc "location=${files[0]}" '!' decodebin '!' videoconvert '!' pngenc snapshot=true '!' \
    filesink "location=$out/left.png"
  compare --disparity "$out/disparity-$mode" --left "$out/left.png" --picture "$out/demo.png" \
    --width 1600 --max-disparity "${max_disparity:-64}"
}

mkdir -p "$out" 2>/dev/null || fail "the folder $out cannot be created"
log=$(mktemp) || fail "a temporary file cannot be created"
trap 'rm -f "$log"' EXIT
out=$(cd "$out" && pwd)
for file in "${files[@]}"; do
  for name in "disparity-$mode.mkv" color.mp4 left.png demo.png; do
    [[ ! $out/$name -ef $file ]] || fail "$file would be overwritten: choose another folder with --out"
  done
done
# Files of an earlier demo are replaced, so those of others must not be among them.
mark=$out/.mtstereo-demo
[[ -e $mark || -z $(ls -A "$out") ]] ||
  fail "$out has files that demo.sh did not write: move them, or choose a new folder with --out"
: >"$mark"

if [ "$build_first" = yes ]; then
  build_all
elif [ ! -e "$build/gst/libgstmtstereo.so" ]; then
  fail "there is no plugin in $build; omit --no-build, or set the build folder with --build"
fi
export GST_PLUGIN_PATH=$build/gst

if [ "$raw" = yes ]; then
  # shellcheck source=pipelines/demo-raw.sh
  source "$here/demo-raw.sh"
  demo_of_raw_cameras
  written=(left.mp4 right.mp4 cameras/calibration.yml depth rectified "disparity-$mode.mkv")
elif [ ${#files[@]} -eq 0 ]; then
  demo_of_clip
  written=(left.mp4 right.mp4 disparity-sparse.mkv disparity-semi-dense.mkv disparity-dense.mkv
    disparity-full.mkv)
else
  demo_of_files
  written=("disparity-$mode.mkv")
fi
echo
echo "Written:"
for name in "${written[@]}" color.mp4 demo.png; do echo "  $out/$name"; done
