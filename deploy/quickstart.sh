#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# From a fresh clone to three line fitters side by side on a simulated RPLIDAR S1. Installs missing
# packages, builds into build/, and runs deploy/examples/look.yaml with its page until Ctrl-C.
# QUOIN_PORT is the port of the page (8765). Arguments go to "quoin up":
#   deploy/quickstart.sh --duration 20 --json
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
build=$root/build

# With --json, standard output belongs to the result.
{
  "$root/deploy/install_packages.sh"
  # A folder that is configured already, perhaps with the tests, stays as it is: changing options back
  # and forth would build everything again each time.
  if [ ! -f "$build/build.ninja" ]; then
    (cd "$root" && cmake --preset release -DQUOIN_TESTS=OFF -DQUOIN_BENCHMARKS=OFF \
      -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=10)  # all at once: two thirds of the time
  fi
  cmake --build "$build" --target quoin quoin-simulated quoin-replay quoin-segmentation \
    quoin-line-fitting quoin-circle-fitting quoin-corner-estimation quoin-recorder quoin-viewer
  printf '\nOpen http://127.0.0.1:%s/ in a browser to look at it.\n\n' "${QUOIN_PORT:-8765}"
} >&2

exec "$build/bin/quoin" up "$root/deploy/examples/look.yaml" "$@"
