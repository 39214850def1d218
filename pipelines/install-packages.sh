#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# install-packages.sh [MARK...]: installs the missing Debian packages of packages.txt; does nothing if
# none is missing. A package with marks after its name is only installed if one of them is given.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
marks=" $* "

missing=() architectures=()
while read -r package needed_for; do
  [ -z "$needed_for" ] || [[ $marks =~ " "(${needed_for// /|})" " ]] || continue
  ! dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || continue
  missing+=("$package")
  case $package in
    *:*) architectures+=("${package##*:}") ;;
  esac
done < <(sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$here/packages.txt")
[ ${#missing[@]} -eq 0 ] && exit 0

echo "Installing Debian packages: ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "These packages are missing, and this user cannot install them. As root, run" >&2
    echo "  apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
for architecture in "${architectures[@]}"; do
  "${as_root[@]}" dpkg --add-architecture "$architecture"
done
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
