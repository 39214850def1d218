#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: installation
#
# Checks that GStreamer finds the plugin of the build folder inside of `meson devenv`, whatever the
# environment outside of it and whatever else is installed.
#
# usage: devenv_test.sh BUILD PLUGIN_FOLDER MESON
set -eu
build=$1 plugin_folder=$2 meson=$3

registry=$(mktemp)
trap 'rm -f "$registry"' EXIT
unset GST_PLUGIN_PATH GST_PLUGIN_PATH_1_0 LD_LIBRARY_PATH
export GST_REGISTRY="$registry"

"$meson" devenv -C "$build" gst-inspect-1.0 mtstereo >"$registry.out" ||
  { echo "failed: gst-inspect-1.0 ended with $?" >&2 && exit 1; }
found=$(sed -n 's/^ *Filename *//p' "$registry.out")
rm -f "$registry.out"
[ "$found" = "$plugin_folder/libgstmtstereo.so" ] ||
  { echo "failed: the plugin is \"$found\", not that of $plugin_folder" >&2 && exit 1; }
