#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes a Debian 12 with debootstrap, installs the packages in it, runs an example as an unprivileged user and removes them.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=tests/debian_root.sh
. "$source/tests/debian_root.sh"

usage() {
  cat <<'TEXT'
usage: tests/packages.sh [--cache FOLDER] [--mirror URL] [--packages FOLDER]
  --cache FOLDER     where the minimal Debian is kept for the next run (/var/cache/quoin-packages)
  --mirror URL       Debian mirror (the one that this machine's packages come from)
  --packages FOLDER  where the .deb files are (build/package; made there if there are none)
Needs root, debootstrap and the network. Nothing outside of the folders is changed.
TEXT
}
cache=/var/cache/quoin-packages
mirror=
packages=$source/build/package
while [[ $# -gt 0 ]]; do
  case $1 in
    --cache) cache=${2:?a folder}; shift 2 ;;
    --mirror) mirror=${2:?a URL}; shift 2 ;;
    --packages) packages=${2:?a folder}; shift 2 ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done
needs_debootstrap packages.sh
if [[ -z $mirror ]]; then mirror=$(mirror_of_this_machine); fi
most_kilobytes=60000  # that the installation may take, with all that it needs

fail() {
  echo "packages.sh: $*" >&2
  exit 1
}

if ! ls "$packages"/quoin_*.deb >/dev/null 2>&1; then
  (cd "$source" && cmake --workflow --preset package)
fi
if command -v lintian >/dev/null; then
  lintian --fail-on error --suppress-tags bad-distribution-in-changes-file "$packages"/*.deb || fail "lintian finds errors"
else
  echo "lintian: skipped, it is not installed"
fi

mkdir -p "$cache"
make_debian bookworm "$cache" "$mirror"
work=$(mktemp -d -p "$cache")
trap 'rm -rf --one-file-system "$work"' EXIT
root=$work/root
cp -a "$cache/root" "$root"
cp "$packages"/quoin_*.deb "$root/tmp"

inside "" apt-get update --quiet=2
# All files but what apt keeps for itself, so that what is left behind shows.
files() { (cd "$root" && find . -xdev \( -path ./var/lib/apt -o -path ./var/cache -o -path ./var/log -o -path ./var/lib/dpkg -o -path ./tmp \) -prune -o -print | sort); }
kilobytes() { (cd "$root" && du -skx --exclude=./var/lib/apt --exclude=./var/cache --exclude=./tmp . | cut -f 1); }

before=$(kilobytes)
files >"$work/before"
inside "" env DEBIAN_FRONTEND=noninteractive sh -c 'apt-get install --yes --quiet=2 --no-install-recommends /tmp/quoin_*.deb' >"$work/log" 2>&1 || {
  cat "$work/log"
  fail "the package cannot be installed"
}
taken=$(($(kilobytes) - before))
echo "installed: $taken kB more"
((taken < most_kilobytes)) || fail "more than $most_kilobytes kB"
for program in gcc g++ cc java; do
  if inside "" sh -c "command -v $program" >/dev/null; then fail "the package brings $program"; fi
done

# A user without rights, a network of nothing but the loopback interface.
inside --net setpriv --reuid 65534 --regid 65534 --clear-groups \
  sh -c 'cd /tmp && HOME=/tmp exec quoin up /usr/share/quoin/examples/side_by_side.yaml --duration 10 --json' >"$work/run.json" 2>"$work/run.log" || {
  cat "$work/run.log"
  fail "quoin up fails"
}
grep -q '"lost": 0' "$work/run.json" || fail "quoin up: $(cat "$work/run.json")"
echo "quoin up, as nobody: $(tail -n 1 "$work/run.log")"

inside "" env DEBIAN_FRONTEND=noninteractive sh -c 'apt-get purge --yes --quiet=2 quoin && apt-get autoremove --purge --yes --quiet=2' >"$work/log" 2>&1 || {
  cat "$work/log"
  fail "the package cannot be removed"
}
files >"$work/after"
left=$(comm -13 "$work/before" "$work/after" | grep -vE '^\./(etc/|var/lib/(systemd|ucf)|run/|dev/|proc/|sys/)' || true)
[[ -z $left ]] || fail "left behind: $left"
echo "removed: nothing but configuration is left"
