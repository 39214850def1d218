#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Makes the generated parts of docs/ anew: the pictures of every stage and the parameter table.
# Usage: docs/update.sh [BUILD]; with --check it only tells whether the table is up to date.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
check=
[ "${1:-}" = --check ] && { check=yes; shift; }
build=${1:-$here/../build}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$build/docs/figures/mtstereo-figures" --parameters > "$work/table"
# The table stands between two marks.
sed -e '/<!-- parameters begin -->/,/<!-- parameters end -->/{//!d}' \
  -e "/<!-- parameters begin -->/r $work/table" "$here/parameters.md" > "$work/parameters.md"

if [ -n "$check" ]; then
  diff -u "$here/parameters.md" "$work/parameters.md" ||
    { echo "docs/parameters.md is not what the parameter table says: run docs/update.sh" >&2; exit 1; }
  exit 0
fi
cp "$work/parameters.md" "$here/parameters.md"
"$build/docs/figures/mtstereo-figures" --pictures "$here/images/stages"
