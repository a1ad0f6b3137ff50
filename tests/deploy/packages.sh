#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs what the packages are made of into a folder, and looks at it: nothing is missing, nothing is there that does not belong,
# the programs find each other, and manual pages and completion can be read.
#   packages.sh BUILD_TREE
set -euo pipefail
build=${1:?build tree}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=false
fail() {
  echo "packages.sh: $*" >&2
  failed=true
}

cmake --install "$build" --component programs --prefix "$work/usr" >/dev/null
cd "$work/usr"

for file in bin/quoin bin/quoin-process bin/quoin-rplidar-emulator \
  lib/udev/rules.d/60-quoin-rplidar.rules lib/systemd/system/quoin@.service \
  share/bash-completion/completions/quoin share/zsh/vendor-completions/_quoin \
  share/man/man1/quoin.1.gz share/man/man1/quoin-up.1.gz share/quoin/examples/look.yaml share/quoin/examples/worlds/flat.yaml \
  share/doc/quoin/copyright share/doc/quoin/changelog.gz share/doc/quoin/changelog.Debian.gz; do
  [[ -f $file ]] || fail "missing: $file"
done
beside=$(find . -type f -o -type l | grep -vE '^\./(bin/quoin|lib/udev/|lib/systemd/|share/(man/man1|quoin/examples|doc/quoin|bash-completion|zsh)/)' || true)
[[ -z $beside ]] || fail "installed beside the package: $beside"
if find . -name '*test*' | grep .; then fail "tests are installed"; fi

# Programs: as the kinds name them, each with a page.
for program in $(bin/quoin methods --json | sed -n 's/^ *"program": "\(.*\)",*$/\1/p' | sort -u); do
  [[ -x bin/$program ]] || fail "missing: bin/$program"
  [[ -f share/man/man1/$program.1.gz ]] || fail "no manual page of $program"
done
for name in segmentation simulated viewer; do
  bin/quoin-$name --help >/dev/null || fail "quoin-$name does not start"
done
# A deployment is read and its programs are found where quoin is.
bin/quoin check share/quoin/examples/look.yaml >/dev/null || fail "quoin check of an installed example"

if command -v systemd-analyze >/dev/null; then
  sed "s#^ExecStart=quoin #ExecStart=$PWD/bin/quoin #" lib/systemd/system/quoin@.service >"$work/quoin@robot.service"
  systemd-analyze verify --man=no --recursive-errors=no "$work/quoin@robot.service" || fail "quoin@.service"
fi

for page in share/man/man1/*.gz; do
  gzip -dc "$page" | head -n 1 | grep -q '^\.TH QUOIN' || fail "no manual page: $page"
  if command -v man >/dev/null; then
    errors=$(LC_ALL=C.UTF-8 MANROFFSEQ='' MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z "$PWD/$page" 2>&1 >/dev/null)
    [[ -z $errors ]] || fail "$page: $errors"
  fi
done
gzip -dc share/man/man1/quoin-up.1.gz | grep -q 'duration' || fail "options are missing in the page of quoin up"
bash -n share/bash-completion/completions/quoin || fail "completion of bash"
completed=$(bash -c 'source share/bash-completion/completions/quoin; COMP_WORDS=(quoin sta); COMP_CWORD=1; _quoin; printf "%s " "${COMPREPLY[@]}"')
[[ $completed == *status* ]] || fail "bash completes 'quoin sta' to '$completed'"

if $failed; then exit 1; fi
echo "$(find . -type f | wc -l) files, $(du -sm . | cut -f 1) MiB before they are stripped"
