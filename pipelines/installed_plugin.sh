# SPDX-License-Identifier: LGPL-2.1-or-later
# shellcheck shell=bash
# Where the installed pipeline scripts find the plugin: installed as plugin.sh, sourced by common.sh.

# Empty if GStreamer searches the folder anyway. Otherwise it is relative to this file.
plugin_folder=$(realpath -m "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/@PLUGIN_FROM_HELPER@")
[ "$plugin_folder" != "@SEARCHED_PLUGIN_FOLDER@" ] || plugin_folder=

# The names of the installed commands in the help.
with_command_names() {
  sed -E 's#(\./pipelines/)?\b(from-(files|cameras|png|side-by-side|network)|network-sender)\.sh#mtstereo-\2#g'
}

plugin_help() {
  :
}

plugin_option() {
  return 1
}

# What the user has set comes first.
use_plugin() {
  [ -n "$plugin_folder" ] || return 0
  local plugin=$plugin_folder/libgstmtstereo.so
  [ -e "$plugin" ] || fail "the plugin is missing ($plugin): install mtstereo again"
  export GST_PLUGIN_PATH=${GST_PLUGIN_PATH:+$GST_PLUGIN_PATH:}$plugin_folder
}
