#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Runs the benchmarks of a built tree and prints their figures: a table, or with --json one JSON object of those
# of extraction and chain (the others have a --json of their own).
# Every figure is a ratio of two things measured in the same run, or stands beside what it is measured against.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
bin=${QUOIN_BUILD_DIR:-$root/build}/bin
format=table
case "${1-}" in
  "") ;;
  --json) format=json ;;
  *) echo "usage: ${BASH_SOURCE[0]} [--json]; the tree must have been built (tests/run.sh does)" >&2; exit 2 ;;
esac
for program in extraction_benchmark chain_benchmark side_by_side_benchmark composed_benchmark rplidar_decoder_benchmark rplidar_bridge_benchmark standby_benchmark security_benchmark attack_benchmark ros2_benchmark; do
  if [[ ! -x $bin/$program ]]; then
    echo "$bin/$program is not there; run tests/run.sh --build-only first" >&2
    exit 2
  fi
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo "extraction: one thread, 920 points" >&2
"$bin/extraction_benchmark" --benchmark_out="$work/extraction.json" --benchmark_out_format=json \
  --benchmark_repetitions=9 --benchmark_report_aggregates_only=true >"$work/extraction.txt" 2>&1
"$bin/chain_benchmark" --extraction "$work/extraction.json" --format "$format"
if [[ $format == table ]]; then
  "$bin/segmentation_benchmark"
  "$bin/side_by_side_benchmark"
  "$bin/composed_benchmark"
  echo "RPLIDAR decoder and bridge" >&2
  "$bin/rplidar_decoder_benchmark"
  "$bin/rplidar_bridge_benchmark"
  echo "standby: 50 kills of the strong instance at 10 Hz, lease 100 ms" >&2
  "$bin/standby_benchmark"
  echo "security: three rounds of 10 s without, signed and encrypted, at 10 Hz" >&2
  "$bin/security_benchmark"
  echo "a hostile neighbour every other second for a minute, at 10 Hz" >&2
  "$bin/attack_benchmark"
  echo "ROS 2: 300 scans at 10 Hz in turn, 3000 at 100 Hz, markers for 20 s" >&2
  "$bin/ros2_benchmark"
fi
