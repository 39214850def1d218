#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes libmtstereo.abi, the ABI that later changes are compared with. Run it at each release, after a
# build with gcc on x86_64: docs/quality.md. usage: tests/abi/update.sh [BUILD]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=${1:-$here/../../build}

ninja -C "$build" tests/abi/libmtstereo-abi.so
"$here/describe.sh" "$build/tests/abi/libmtstereo-abi.so" "$here/../../core/include/mtstereo" \
  >"$here/libmtstereo.abi.new"
mv "$here/libmtstereo.abi.new" "$here/libmtstereo.abi"
sed -n "1s/.* soname='\([^']*\)'.*/libmtstereo.abi describes \1/p" "$here/libmtstereo.abi"
