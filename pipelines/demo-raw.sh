# SPDX-License-Identifier: LGPL-2.1-or-later
# shellcheck shell=bash
# The demo of raw cameras, demo.sh --raw: calibration, rectification, depths in meters. Sourced only.

# shellcheck disable=SC2154  # the variables are those of demo.sh

raw_baseline=0.3 # [m]

# A board as mtcalibrate prints it, seen by two raw cameras, and the calibration that follows.
calibrate_cameras() {
  local board=(--squares 9x6 --square 60 --paper A2)
  step "The board of mtcalibrate, seen by two raw cameras in 40 poses"
  mtcalibrate --board "$out/board.png" "${board[@]}" >"$log" 2>&1 ||
    { cat "$log" >&2 && fail "the board could not be drawn"; }
  # The page is 594 mm wide.
  mtstereo-render "$out/board" --overwrite --scene board --lens wide --size "$size" \
    --baseline "$raw_baseline" --picture "$out/board.png" --picture-width 0.594 --poses 40 \
    --visible 0.6 --noise 1 --gray >"$log" || fail "the board could not be rendered"
  step "Calibrating the cameras with mtcalibrate"
  mtcalibrate --left "$out/board/left" --right "$out/board/right" "${board[@]}" \
    --out "$out/cameras" --overwrite | sed '/^view /d' ||
    fail "the cameras could not be calibrated"
  calibration=$out/cameras/calibration.yml
}

# Two raw files -> disparities without loss, depths in mm as PNG files, and the rectified left view.
measure() {
  local matcher=(mtstereo name=m "mode=$mode" "max-disparity=$max_disparity") folder
  local rectify=(mtrectify "calibration=$calibration" ${alpha:+"alpha=$alpha"})
  if [ -n "$rectified_size" ]; then
    rectify+=("width=${rectified_size%x*}" "height=${rectified_size#*x}")
    # shellcheck disable=SC2034  # to_color reads them
    odd_width=$((${rectified_size%x*} % 2)) odd_height=$((${rectified_size#*x} % 2))
  fi
  local to_png=(videoconvert '!' 'video/x-raw,format=GRAY16_BE' '!' pngenc)
  for folder in depth rectified; do
    rm -rf "${out:?}/$folder"
    mkdir -p "$out/$folder"
  done
  play \
    filesrc "location=$out/left.mp4" '!' decodebin '!' videoconvert '!' \
    "${rectify[@]}" camera=left '!' tee name=view \
    view. '!' queue '!' m.sink_left \
    view. '!' queue '!' pngenc '!' multifilesink "location=$out/rectified/%06d.png" \
    filesrc "location=$out/right.mp4" '!' decodebin '!' videoconvert '!' \
    "${rectify[@]}" camera=right '!' queue '!' m.sink_right \
    "${matcher[@]}" '!' watchdog timeout=60000 '!' tee name=maps \
    maps. '!' queue '!' avenc_ffv1 '!' matroskamux '!' filesink "location=$out/disparity-$mode.mkv" \
    maps. '!' queue '!' mtdepth '!' "${to_png[@]}" '!' \
    multifilesink "location=$out/depth/%06d.png"
}

demo_of_raw_cameras() {
  export PATH=$build/pipelines/tools/render:$build/pipelines/programs/calibrate:$PATH
  calibrate_cameras
  render_clip --lens wide --baseline "$raw_baseline" --rectification "$calibration" --depth \
    ${alpha:+--alpha "$alpha"} ${rectified_size:+--rectified-size "$rectified_size"}
  step "Rectifying and matching the two files, mode $mode"
  measure
  step "Color video and image"
  to_images "$mode"
  to_color
  echo
  echo "Disparities against the ground truth: avgerr px, D-all %, density %, mean over the clip."
  compare --label "$mode" --disparity "$out/disparity-$mode" --truth "$out/clip/truth" \
    --left "$out/rectified" --picture "$out/demo.png" --width 1200 --frame $((frames / 2)) \
    --max-disparity "$max_disparity"
  echo
  echo "Depths against the ground truth, from the cameras that mtcalibrate measured: pixels with a"
  echo "depth, and the error that half and nine tenths of them do not exceed."
  compare --depth "$out/depth" --true-depth "$out/clip/depth"
}
