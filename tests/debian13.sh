#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes a Debian 13 with debootstrap, and runs the README's two commands in it: deploy/quickstart.sh and tests/run.sh. Then
# deployments of which half is in it and half is of this machine, where this tree has been built (tests/two_versions.sh).
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=tests/debian_root.sh
. "$source/tests/debian_root.sh"

usage() {
  cat <<'TEXT'
usage: tests/debian13.sh [--cache FOLDER] [--mirror URL] [--quick | --short] [-- ARGUMENTS]
  --cache FOLDER  where the root, its build and its ccache are kept for the next run (/var/cache/quoin-debian13)
  --mirror URL    Debian mirror (the one that this machine's packages come from)
  --quick         leave out tests/run.sh: only what deploy/quickstart.sh does
  --short         in place of tests/run.sh: unit tests, those of DDS, and integration tests of one deployment
  ARGUMENTS       for tests/run.sh in the root (--no-sanitizers)
Needs root, debootstrap, iproute2 and the network, which packages alone come by: what is built runs on a loopback of its own.
Builds a copy of this tree; nothing outside of FOLDER is changed.
TEXT
}
cache=/var/cache/quoin-debian13
mirror=
quick=false
short=false
arguments=(--no-sanitizers)
while [[ $# -gt 0 ]]; do
  case $1 in
    --cache) cache=${2:?a folder}; shift 2 ;;
    --mirror) mirror=${2:?a URL}; shift 2 ;;
    --quick) quick=true; shift ;;
    --short) short=true; shift ;;
    --) shift; arguments=("$@"); break ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done
needs_debootstrap debian13.sh
mirror=${mirror:-$(mirror_of_this_machine)}
mkdir -p "$cache"
cache=$(cd "$cache" && pwd)
root=$cache/root

# step NAME COMMAND...: with its time at the end.
step() {
  local begin=$SECONDS
  printf '\n== Debian 13: %s\n' "$1"
  "${@:2}"
  printf '== Debian 13: %s took %d s\n' "$1" $((SECONDS - begin))
}

# All that git knows or would know, with its times: what is built already stays built.
copy_sources() {
  mkdir -p "$root/quoin"
  find "$root/quoin" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
  git -C "$source" -c safe.directory='*' ls-files --cached --others --exclude-standard -z |
    (cd "$source" && while IFS= read -r -d '' file; do [[ ! -e $file ]] || printf '%s\0' "$file"; done) |
    tar --create --directory="$source" --null --files-from=- | tar --extract --directory="$root/quoin"
}

short_tests() {
  # shellcheck disable=SC2016
  inside --net bash -ec '
    cd /quoin
    cmake --preset release -DQUOIN_TESTS=ON -DQUOIN_BENCHMARKS=OFF
    cmake --build build --target quick_tests integration_test
    ctest --test-dir build --output-on-failure -L "unit|dds" -j "$(($(nproc) + 1))"
    ctest --test-dir build --output-on-failure -L integration -R "^(Chain|Security|Status|Up)\." -j "$(($(nproc) + 1))"'
}

step "root" make_debian trixie "$cache" "$mirror"
step "copy of the sources" copy_sources
step "packages" inside "" /quoin/deploy/install_packages.sh
step "deploy/quickstart.sh" inside --net /quoin/deploy/quickstart.sh --duration 20 --json
if ! $quick; then
  step "packages for tests" inside "" /quoin/deploy/install_packages.sh /quoin/tests/packages.txt
  if $short; then
    step "unit tests, those of DDS and some of integration" short_tests
  else
    step "tests/run.sh" inside --net /quoin/tests/run.sh "${arguments[@]}"
  fi
fi
if [[ -x $source/build/bin/quoin && -x $source/build/bin/quoin-corner-estimation ]]; then
  step "this machine and it in one deployment" "$source/tests/two_versions.sh" --root "$root"
fi
