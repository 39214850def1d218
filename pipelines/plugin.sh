# SPDX-License-Identifier: LGPL-2.1-or-later
# shellcheck shell=bash
# Where the pipeline scripts find the plugin: in a build folder. Sourced by common.sh. An installation
# has installed_plugin.sh in the place of this file.

set_build_folder() {
  build=$1
  plugin_folder=$build/gst
}
set_build_folder "${BUILD:-$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)/build}"

with_command_names() {
  cat
}

plugin_help() {
  echo "  --build DIR         build folder of mtstereo (default: build/, or \$BUILD)"
}

plugin_option() {
  [ "$1" = --build ] || return 1
  set_build_folder "$2"
}

use_plugin() {
  local plugin=$plugin_folder/libgstmtstereo.so
  [ -e "$plugin" ] ||
    fail "the plugin is not built ($plugin does not exist); build it with" \
      "'meson setup $build && ninja -C $build', or set the build folder with --build"
  export GST_PLUGIN_PATH=$plugin_folder${GST_PLUGIN_PATH:+:$GST_PLUGIN_PATH}
}
