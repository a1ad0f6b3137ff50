#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs what is missing, builds, and runs every test through CTest: the release build with everything, then all but the
# integration tests under AddressSanitizer and UndefinedBehaviorSanitizer, what has threads under ThreadSanitizer, and
# a short run of the fuzz targets; the format of the sources, and clang-tidy over them. What mostly waits runs beside what
# compiles.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

usage() {
  cat <<'TEXT'
usage: tests/run.sh [--build-only] [--no-sanitizers] [--no-fuzzing] [--no-tidy]
  --build-only      install and build the release tree, run nothing
  --no-sanitizers   leave out the builds with sanitizers
  --no-fuzzing      leave out the fuzz targets, which need clang++
  --no-tidy         leave out clang-tidy, which takes some eight minutes
TEXT
}
build_only=false
sanitizers=true
fuzzing=true
tidy=true
for argument in "$@"; do
  case $argument in
    --build-only) build_only=true ;;
    --no-sanitizers) sanitizers=false ;;
    --no-fuzzing) fuzzing=false ;;
    --no-tidy) tidy=false ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

# Format, clang-tidy and fuzz targets are for clang 14, which Debian 12 has and Debian 13 has not.
clang=true
if ! command -v clang-format-14 >/dev/null && ! apt-cache show clang-format-14 >/dev/null 2>&1; then
  echo "clang 14 is not to be had here: format, fuzz targets and clang-tidy are left out"
  clang=false
  fuzzing=false
  tidy=false
fi

step() { printf '\n== %d:%02d  %s\n' $((SECONDS / 60)) $((SECONDS % 60)) "$*"; }
jobs=$(nproc)
tests_at_once=$((jobs + 1))  # some of them wait most of the time

work=$(mktemp -d)
declare -A background=()  # by name, the process group of each step that runs beside others
end_background() {
  local group
  for group in "${background[@]}"; do kill -- "-$group" 2>/dev/null || true; done
  rm -rf "$work"
}
trap end_background EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# in_background NAME COMMAND...: starts a step of which `finish NAME` shows the output. A group of its own lets it be
# ended with all that it has started.
in_background() {
  step "$1 (begins; its output follows below)"
  setsid "${@:2}" >"$work/$1" 2>&1 </dev/null &
  background[$1]=$!
}

# Waits for a step in the background, shows what it printed, and fails if it did.
finish() {
  local status=0
  wait "${background[$1]}" || status=$?
  unset "background[$1]"
  step "$1 (ran beside the steps above)"
  cat "$work/$1"
  return "$status"
}

step "packages"
deploy/install_packages.sh
if ! $build_only; then
  deploy/install_packages.sh tests/packages.txt
  if $clang; then deploy/install_packages.sh tests/packages_clang.txt; fi
  # What npm brings is for tests of the page alone; without it they are skipped.
  if command -v npm >/dev/null; then
    (cd tests/npm && npm ci --no-audit --no-fund) || echo "npm packages are missing: tests with them are skipped"
  fi
fi

if $clang && ! $build_only; then
  step "format"
  tests/style.sh format
fi

# Nothing that runs from here may leave anything there.
export TMPDIR=$work/tmp
mkdir "$TMPDIR"

step "release build"
options=(-DQUOIN_TESTS=ON -DQUOIN_BENCHMARKS=ON)
# From nothing several sources at once take two thirds of the time. A folder that is there stays as it is.
[[ -f build/build.ninja ]] || options+=(-DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=10)
cmake --preset release "${options[@]}"
cmake --build --preset release -j "$jobs"
$build_only && exit 0

step "all tests but those of integration"
ctest --test-dir build --output-on-failure -LE integration -j "$tests_at_once"

in_background "soak" tests/soak/run.sh --minutes 3
in_background "integration tests" ctest --test-dir build --output-on-failure -L integration -j "$tests_at_once"
if $sanitizers; then
  step "build with sanitizers"
  cmake --preset asan
  nice cmake --build --preset asan -j "$jobs" --target quick_tests  # gives way to what runs beside it
  step "build with the thread sanitizer"
  cmake --preset tsan
  nice cmake --build --preset tsan -j "$jobs" --target thread_tests
fi
finish "integration tests"
finish "soak"

if $sanitizers; then
  step "tests with sanitizers"
  # Fast DDS frees some of its objects as their base classes.
  export ASAN_OPTIONS=new_delete_type_mismatch=0 UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS=suppressions=$root/tests/sanitizers/leak.supp
  ctest --test-dir build/asan --output-on-failure -L 'unit|dds' -j "$tests_at_once"
  step "tests with the thread sanitizer"
  export TSAN_OPTIONS="suppressions=$root/tests/sanitizers/thread.supp halt_on_error=1"
  ctest --test-dir build/tsan --output-on-failure -L threads -j "$tests_at_once"
fi

# Beside nothing that has deadlines of its own.
in_background "soaks of kinds with several ports, and of processes with several services" \
  bash -c 'tests/soak/run.sh --minutes 3 --kinds && tests/soak/run.sh --minutes 3 --composed'
if $fuzzing; then
  step "fuzz targets"
  tests/fuzz/run.sh
fi
if $tidy; then
  step "clang-tidy"
  nice tests/style.sh tidy
fi
finish "soaks of kinds with several ports, and of processes with several services"

step "temporary files left behind"
if [[ -n $(ls -A "$TMPDIR") ]]; then
  ls -AR "$TMPDIR"
  exit 1
fi
