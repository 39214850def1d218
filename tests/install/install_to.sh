#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Installs the build below a temporary folder. The list of installed files that 'ninja uninstall' reads
# stays that of the real installation, and two tests do not write it at the same time.
#
# usage: install_to.sh BUILD MESON FOLDER
set -eu
build=$1 meson=$2 folder=$3
log=$build/meson-logs/install-log.txt

exec 9>"$build/meson-private/install-tests.lock"
flock 9
kept=
if [ -e "$log" ]; then
  kept=$(mktemp)
  cp "$log" "$kept"
fi
status=0
"$meson" install --no-rebuild --quiet -C "$build" --destdir "$folder" >"$folder.log" 2>&1 || status=$?
if [ -n "$kept" ]; then
  mv "$kept" "$log"
else
  rm -f "$log"
fi
[ "$status" -eq 0 ] || cat "$folder.log" >&2
rm -f "$folder.log"
exit "$status"
