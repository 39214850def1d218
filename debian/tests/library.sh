#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Programs build and run with the packages of the libraries and pkg-config alone.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$AUTOPKGTEST_TMP"

# The flags are split into words on purpose.
# shellcheck disable=SC2046
g++ -std=c++20 "$source/tests/install/installed_program.cpp" -o program $(pkg-config --cflags --libs mtstereo)
output=$(./program)
echo "version and matched pixels: $output"
[ "${output##* }" -gt 500 ]

(cd /usr/include && find mtstereo -name '*.hpp' -printf '#include <%p>\n') >geometry.cpp
cat >>geometry.cpp <<'END'
int main() {
  return mtstereo::read_calibration("missing.yml") ? 1 : 0;
}
END
# shellcheck disable=SC2046
g++ -std=c++20 geometry.cpp -o geometry $(pkg-config --cflags --libs mtstereo mtstereo-geometry)
./geometry
