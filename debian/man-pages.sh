#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# man-pages.sh ROOT VERSION: makes the manual page ROOT/man/NAME.1 of each command below ROOT, from its --help.
set -eu
root=$1 version=$2
LD_LIBRARY_PATH=$(dirname "$root"/usr/lib/*/libmtstereo.so)
export LD_LIBRARY_PATH
mkdir -p "$root/man"
for command in "$root"/usr/bin/*; do
  name=$(basename "$command")
  # The first sentence of the help; that of the scripts begins with their arguments.
  purpose=$("$command" --help | tr '\n' ' ' | sed -E -e "s/^${name}[^:]*: //" -e 's/\. .*//')
  help2man --no-info --name="$purpose" --version-string="$version" --source="mtstereo $version" \
    --output="$root/man/$name.1" "$command"
  # Long lists of choices, {a,b,c}, are broken after commas.
  sed -i '/{.*,.*}/ s/,/,\\:/g' "$root/man/$name.1"
done
