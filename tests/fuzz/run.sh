#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the fuzz targets with clang++ in build/fuzz and runs each of them from its kept corpus, of which
# it changes nothing. Prints the executions; a finding is kept in build/fuzz/findings and makes it fail.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build/fuzz

usage() {
  cat <<'TEXT'
usage: tests/fuzz/run.sh [--seconds N | --runs N]
  --seconds N   let each target run so long (default: 4)
  --runs N      let each target run so many executions
TEXT
}
limit=-max_total_time=4
while (($# > 0)); do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --seconds) option=-max_total_time ;;
    --runs) option=-runs ;;
    *) usage >&2; exit 2 ;;
  esac
  [[ ${2-} =~ ^[1-9][0-9]*$ ]] || { usage >&2; exit 2; }
  limit=$option=$2
  shift 2
done

compiler=$(command -v clang++ || command -v clang++-14) ||
  { echo "clang++ is not there; install clang and libclang-rt-dev" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release \
  -DQUOIN_FUZZ=ON -DQUOIN_DDS=OFF -DQUOIN_TESTS=OFF -DQUOIN_BENCHMARKS=OFF >"$work/build.txt" 2>&1 &&
  cmake --build "$build" -j "$(nproc)" --target fuzz_sample_decoder fuzz_descriptor fuzz_cdr_json fuzz_message_check fuzz_idl \
    fuzz_viewer fuzz_mcap fuzz_bag fuzz_scan_message >>"$work/build.txt" 2>&1 ||
  { cat "$work/build.txt" >&2; exit 2; }

failed=0
mkdir -p "$build/findings"
for target in sample_decoder descriptor cdr_json message_check idl viewer mcap bag scan_message; do
  cp -r "$root/tests/fuzz/corpus/$target" "$work/$target"
  status=0
  "$build/bin/fuzz_$target" "$work/$target" "$limit" -max_len=4096 -timeout=10 -print_final_stats=1 \
    -artifact_prefix="$build/findings/$target-" >"$work/$target.txt" 2>&1 || status=$?
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$work/$target.txt")
  if ((status != 0)); then
    tail -n 40 "$work/$target.txt" >&2
    echo "fuzz_$target: a finding after ${executions:-some} executions, see $build/findings" >&2
    failed=1
  else
    echo "fuzz_$target: $executions executions, nothing found"
  fi
done
exit "$failed"
