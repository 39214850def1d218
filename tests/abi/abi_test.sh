#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: the ABI of a version stays
#
# Compares a library's ABI with that of the last release, which libmtstereo.abi or libmtstereo-geometry.abi
# describes. They may differ only if the soname does: docs/quality.md.
#
# usage: abi_test.sh LIBRARY LIBRARY_WITH_DEBUG_INFORMATION HEADER_FOLDER SONAME
set -eu
here=$(cd "$(dirname "$0")" && pwd)

library=$1 debug_library=$2 headers=$3 soname=$4
name=${soname%.so.*}
released=$here/$name.abi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
  echo "failed: $*" >&2
  exit 1
}
# A constructor's symbols C1 and C2 are one function, as are D1 and D2 of a destructor.
sorted() {
  sed 's/\([CD]\)2E/\11E/' | LC_ALL=C sort -u
}

"$here/describe.sh" "$debug_library" "$headers" >"$work/current.abi" || fail "abidw"

# The description is complete: the library with debug information is made from the sources of the API alone.
nm -D --defined-only "$library" | awk '$2 == "T" { print $3 }' | sorted >"$work/exported"
[ -s "$work/exported" ] || fail "$library exports no function"
sed -n "s/.* elf-symbol-id='\([^']*\)'.*/\1/p" "$work/current.abi" | sorted >"$work/described"
missing=$(LC_ALL=C comm -23 "$work/exported" "$work/described" | c++filt)
[ -z "$missing" ] || fail "the ABI description lacks functions that the library exports. Add the source
files that define them to core_api_sources (core/meson.build) or geometry_api_sources (core/geometry/meson.build):
$missing"

released_soname=$(sed -n "1s/.* soname='\([^']*\)'.*/\1/p" "$released")
case $released_soname in
  "$name".so.*) ;;
  *) fail "$name.abi has no soname" ;;
esac
if [ "$released_soname" != "$soname" ]; then
  newest=$(printf '%s\n' "$released_soname" "$soname" | sort -V | tail -n 1)
  [ "$newest" = "$soname" ] || fail "$soname is older than the released $released_soname"
  echo "not compared: this is $soname, and the last described release is $released_soname"
  exit 0
fi

# abidiff skips types that only inline functions use, such as ErrorCode. Their enumerators are compared here.
enumerators_of() {
  awk -F "'" '/<enum-decl / { type = $2 } /<enumerator / { print type "::" $2 " = " $4 }' "$1" |
    LC_ALL=C sort -u
}
enumerators_of "$released" >"$work/released.enums"
enumerators_of "$work/current.abi" >"$work/current.enums"

status=0
abidiff --harmless --no-show-locs "$released" "$work/current.abi" >"$work/difference" 2>&1 || status=$?
# Bit 2 says that the ABIs differ, bit 3 that programs break; all other bits are errors of abidiff itself.
case $status in
  0 | 4 | 12) ;;
  *) cat "$work/difference" && fail "abidiff ended with $status" ;;
esac
if diff "$work/released.enums" "$work/current.enums" && [ "$status" -eq 0 ]; then
  echo "the ABI of $soname has not changed: $(wc -l <"$work/exported") functions," \
    "$(wc -l <"$work/current.enums") enumerators"
  exit 0
fi
cat "$work/difference"
fail "the ABI is not that of the released $soname. If the change is intended: raise the
minor version in meson.build, describe the change in CHANGELOG.md, and run tests/abi/update.sh at the
release. If the minor version was raised already and is not released yet, run tests/abi/update.sh now."
