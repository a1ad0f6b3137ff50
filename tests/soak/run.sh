#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Runs a deployment of a built tree under random kills, pauses, swaps, changes of the composition, visitors,
# malformed requests and a hostile neighbour; fails when a scan is not accounted for, memory has grown, or anything is left behind.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=${QUOIN_BUILD_DIR:-$root/build}/bin/soak
if [[ ! -x $program ]]; then
  echo "$program is not there; run tests/run.sh --build-only first" >&2
  exit 2
fi
exec "$program" "$@"
