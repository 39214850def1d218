#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# set-version.sh VERSION: names the packages after a new version x.y.z. Those of the libraries are named after x.y.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
[[ ${1:-} =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || { echo "set-version.sh: expected a version such as 0.14.0" >&2 && exit 2; }
old=$(dpkg-parsechangelog -l changelog -S Version)
[ "$1" != "$old" ] || { echo "set-version.sh: the packages have version $old already" >&2 && exit 1; }

for library in libmtstereo libmtstereo-geometry; do
  [ "${1%.*}" = "${old%.*}" ] || mv "$library${old%.*}.install" "$library${1%.*}.install"
  sed -i "s/\\b$library${old%.*}\\b/$library${1%.*}/g" control
done
entry="mtstereo ($1) unstable; urgency=medium

  * CHANGELOG.md says what this version changes.

 -- $(dpkg-parsechangelog -l changelog -S Maintainer)  $(date -R -u)
"
printf '%s\n%s\n' "$entry" "$(cat changelog)" >changelog
