#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Every element of the plugin exists, and a pipeline finds the right disparities.
set -euo pipefail
# shellcheck source=debian/tests/views.sh
source "$(dirname "${BASH_SOURCE[0]}")/views.sh"

gst-inspect-1.0 mtstereo >about.txt
for element in mtcloud mtcolor mtconfidence mtdepth mtrectify mtsplit mtstereo mtwhole; do
  gst-inspect-1.0 "$element" >about.txt || fail "there is no element $element"
done

views 1 'm.sink_left' 'm.sink_right mtstereo name=m ! filesink location=map.raw'
require_8_px map.raw
views 1 'm.sink_left' 'm.sink_right mtstereo name=m ! mtcolor ! videoconvert ! pngenc ! filesink location=map.png'
[ "$(head -c 4 map.png | tail -c 3)" = PNG ] || fail "map.png is no image"
