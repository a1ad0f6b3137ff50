#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs what is missing, builds, and runs every test through CTest: the release build with everything,
# then the unit tests under AddressSanitizer and UndefinedBehaviorSanitizer, and a short run of the fuzz targets.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

usage() {
  cat <<'TEXT'
usage: tests/run.sh [--build-only] [--no-sanitizers] [--no-fuzzing]
  --build-only      install and build the release tree, run nothing
  --no-sanitizers   leave out the second build with sanitizers
  --no-fuzzing      leave out the fuzz targets, which need clang++
TEXT
}
build_only=false
sanitizers=true
fuzzing=true
for argument in "$@"; do
  case $argument in
    --build-only) build_only=true ;;
    --no-sanitizers) sanitizers=false ;;
    --no-fuzzing) fuzzing=false ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

step() { printf '\n== %s\n' "$*"; }
jobs=$(nproc)
tests_at_once=$((jobs + 1))  # some of them wait most of the time

step "packages"
deploy/install_packages.sh
if ! $build_only; then deploy/install_packages.sh tests/packages.txt; fi

step "release build"
cmake --preset release -DQUOIN_TESTS=ON -DQUOIN_BENCHMARKS=ON
cmake --build --preset release -j "$jobs"
$build_only && exit 0

step "all tests"
ctest --test-dir build --output-on-failure -j "$tests_at_once"

if $sanitizers; then
  step "unit tests with sanitizers"
  cmake --preset asan
  cmake --build --preset asan -j "$jobs"
  UBSAN_OPTIONS=print_stacktrace=1 ctest --test-dir build/asan --output-on-failure -L unit -j "$tests_at_once"
fi

if $fuzzing; then
  step "fuzz targets"
  tests/fuzz/run.sh
fi
