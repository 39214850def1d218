#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# man-pages.sh ROOT VERSION [EMULATOR]: makes the manual page ROOT/man/NAME.1 of each command below ROOT, from its
# --help. EMULATOR starts the programs of another architecture.
set -eu
root=$1 version=$2 emulator=${3:-}
LD_LIBRARY_PATH=$(dirname "$root"/usr/lib/*/libmtstereo.so)
export LD_LIBRARY_PATH
starters=$(mktemp -d)
trap 'rm -r "$starters"' EXIT
mkdir -p "$root/man"
for command in "$root"/usr/bin/*; do
  name=$(basename "$command")
  if [ -n "$emulator" ] && [ "$(head -c 2 "$command")" != '#!' ]; then
    printf '#!/bin/sh\nexec %s "%s" "$@"\n' "$emulator" "$command" >"$starters/$name"
    chmod +x "$starters/$name"
    command=$starters/$name
  fi
  # The first sentence of the help; that of the scripts begins with their arguments.
  purpose=$("$command" --help | tr '\n' ' ' | sed -E -e "s/^${name}[^:]*: //" -e 's/\. .*//')
  help2man --no-info --name="$purpose" --version-string="$version" --source="mtstereo $version" \
    --output="$root/man/$name.1" "$command"
  # Long lists of choices, {a,b,c}, are broken after commas.
  sed -i '/{.*,.*}/ s/,/,\\:/g' "$root/man/$name.1"
done
