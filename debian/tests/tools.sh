#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# The programs and the ready pipelines find the right disparities of images and of a video, and have manual pages.
set -euo pipefail
# shellcheck source=debian/tests/views.sh
source "$(dirname "${BASH_SOURCE[0]}")/views.sh"

# Values of a 16-bit image, in the order of this machine.
pixels() {
  gst-launch-1.0 -q filesrc location="$1" ! pngdec ! videoconvert ! video/x-raw,format=GRAY16_LE ! filesink location="$2"
}

mkdir left right
views 3 'pngenc ! multifilesink location=left/%06d.png' 'pngenc ! multifilesink location=right/%06d.png'

mtstereo-run left right --out run --format png --what disparity,color
pixels "$(find run -name '*2.png' -path '*disparity*' | head -1)" run.raw
require_8_px run.raw

mtstereo-from-png left/%06d.png right/%06d.png map/%06d.png
pixels map/000002.png map.raw
require_8_px map.raw

views 3 'avenc_ffv1 ! matroskamux ! filesink location=left.mkv' 'avenc_ffv1 ! matroskamux ! filesink location=right.mkv'
mtstereo-from-files left.mkv right.mkv --out map.mkv
[ -s map.mkv ] || fail "map.mkv is empty"

mtcalibrate --board board.pdf
[ "$(head -c 4 board.pdf)" = %PDF ] || fail "board.pdf is no document"

names=$(dpkg -L mtstereo-tools | sed -n 's#^/usr/bin/##p')
for name in $names; do
  "$name" --help >help.txt || fail "$name --help"
  man --path "$name" >page.txt || fail "$name has no manual page"
done
