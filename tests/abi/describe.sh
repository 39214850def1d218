#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Prints the ABI of a library with debug information as XML: its soname, its exported functions, and
# the size, members and values of the types in the public headers. Types of the standard library
# are left out, because they are not ours to keep stable; what they contribute to the size of our
# types and to the names of our functions stays. The output depends on the source code alone.
#
# usage: describe.sh LIBRARY HEADER_FOLDER
set -eu

rules=$(mktemp)
trap 'rm -f "$rules"' EXIT
headers=$(cd "$2" && printf '%s\n' *.hpp | paste -s -d , -)
cat >"$rules" <<EOF
[suppress_type]
  source_location_not_in = $headers
  drop = yes
[suppress_type]
  name_regexp = ^(std|__gnu_cxx)::
  drop = yes
[suppress_function]
  symbol_name_not_regexp = ^_ZNK?8mtstereo
  drop = yes
[suppress_function]
  name_not_regexp = mtstereo
  drop = yes
EOF

# Paths of source files are shortened to names: they depend on the build folder.
abidw --suppressions "$rules" --type-id-style hash --no-show-locs --no-corpus-path --no-comp-dir-path \
  --no-elf-needed --no-parameter-names --drop-undefined-syms --exported-interfaces-only "$1" |
  sed -e "/<abi-instr /s/ path='[^']*\// path='/"
