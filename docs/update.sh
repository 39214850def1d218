#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Updates the generated parts of docs/: the images of the stages and of the architecture, and the
# tables of parameters, steps and features.
# Usage: docs/update.sh [BUILD]; with --check it only reports whether the table of parameters is up to
# date and docs/method.md describes every step.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
check=
[ "${1:-}" = --check ] && { check=yes; shift; }
build=${1:-$here/../build}
figures=$build/docs/figures/mtstereo-figures

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0

# update PAGE NAME: puts the table $work/NAME between the two marks of docs/PAGE, or compares it.
update() {
  local page=$1 name=$2
  for mark in "<!-- $name begin -->" "<!-- $name end -->"; do
    grep -qxF -e "$mark" "$here/$page" || { echo "docs/$page has no line $mark" >&2; exit 1; }
  done
  sed -e "/<!-- $name begin -->/,/<!-- $name end -->/{//!d}" \
    -e "/<!-- $name begin -->/r $work/$name" "$here/$page" > "$work/page"
  if [ -z "$check" ]; then
    cp "$work/page" "$here/$page"
  elif ! diff -u "$here/$page" "$work/page"; then
    echo "docs/$page is out of date: run docs/update.sh" >&2
    status=1
  fi
}

"$figures" --parameters > "$work/parameters"
update parameters.md parameters
"$figures" --steps > "$work/list"
while read -r _ step _; do
  grep -qF "\`$step\`" "$here/method.md" ||
    { echo "docs/method.md does not describe the step $step" >&2; status=1; }
done < "$work/list"
if [ -z "$check" ]; then
  "$here/figures/architecture.py" table < "$work/list" > "$work/steps"
  update architecture.md steps
  "$here/figures/features.py"
  "$figures" --images "$here/images/stages"
  "$here/figures/architecture.py" image "$here/images/architecture.png" < "$work/list"
fi
exit "$status"
