#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: leaks, sanitizers, fuzzing
# fuzz_test.sh: runs one fuzzing program for a time.
#
# usage: fuzz_test.sh PROGRAM NAME SEEDS REGRESSIONS SECONDS [FOLDER]
#
# FOLDER keeps the inputs: corpus/ those that reach new branches, and the files next to it those that fail. Without
# FOLDER nothing is kept, and the input of a failure is printed as base64: decode it into a file of REGRESSIONS, which
# is run by every build from then on. The inputs are then the same in each run of a build, unless the program has
# threads or the system does not allow fixed addresses: what libFuzzer counts as a new branch depends on both.
set -euo pipefail
program=$1 name=$2 seeds=$3 regressions=$4 seconds=$5 folder=${6:-}
fixed_addresses=() seed=0
source_folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

if [ -z "$folder" ]; then
  folder=$(mktemp -d "${TMPDIR:-/tmp}/mtstereo-fuzz-$name-XXXXXX")
  trap 'rm -rf "$folder"' EXIT
  seed=1 # 0 is one that libFuzzer chooses
  ! setarch --addr-no-randomize true 2>/dev/null || fixed_addresses=(setarch --addr-no-randomize)
fi
mkdir -p "$folder/corpus"
inputs=("$seeds")
[ ! -d "$regressions" ] || inputs+=("$regressions")

export LSAN_OPTIONS=suppressions=$source_folder/tests/lsan.supp:print_suppressions=0
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
# Leaks are found only if GLib frees what it no longer needs.
export G_SLICE=always-malloc
"${fixed_addresses[@]}" "$program" -max_total_time="$seconds" -seed="$seed" -timeout=60 -rss_limit_mb=3000 \
  -max_len=4096 -print_final_stats=1 -artifact_prefix="$folder/" "$folder/corpus" "${inputs[@]}"
