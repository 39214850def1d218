#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes libmtstereo.abi and libmtstereo-geometry.abi, the ABIs that later changes are compared with. Run it at each
# release, after a build with gcc on x86_64: docs/quality.md. usage: tests/abi/update.sh [BUILD]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=${1:-$here/../../build}
headers=$here/../../core/include/mtstereo

# update LIBRARY HEADER_FOLDER
update() {
  ninja -C "$build" "tests/abi/$1-abi.so"
  "$here/describe.sh" "$build/tests/abi/$1-abi.so" "$2" >"$here/$1.abi.new"
  mv "$here/$1.abi.new" "$here/$1.abi"
  sed -n "1s/.* soname='\([^']*\)'.*/$1.abi describes \1/p" "$here/$1.abi"
}

update libmtstereo "$headers"
update libmtstereo-geometry "$headers/geometry"
