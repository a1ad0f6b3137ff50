#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes docs/images/live.png anew: the page of deploy/examples/look.yaml, filmed by Chromium. Needs a build, chromium, and
# the packages of tests/npm (npm ci).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
port=${QUOIN_PORT:-8765}
work=$(mktemp -d)
QUOIN_PORT=$port "$root/build/bin/quoin" up "$root/deploy/examples/look.yaml" --quiet >"$work/up.txt" 2>&1 &
up=$!
trap 'kill -INT "$up" 2>/dev/null || true; wait "$up" 2>/dev/null || true; rm -rf "$work"' EXIT
for _ in $(seq 100); do
  if grep -q "page at" "$work/up.txt"; then break; fi
  sleep 0.2
done
node "$root/tests/npm/animate.mjs" "http://127.0.0.1:$port/" "$root/docs/images/live.png"
