#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes a Debian 13 with debootstrap, and runs the README's two commands in it: deploy/quickstart.sh and tests/run.sh.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  cat <<'TEXT'
usage: tests/debian13.sh [--cache FOLDER] [--mirror URL] [--quick] [-- ARGUMENTS]
  --cache FOLDER  where the root, its build and its ccache are kept for the next run (/var/cache/quoin-debian13)
  --mirror URL    Debian mirror (the one that this machine's packages come from)
  --quick         leave out tests/run.sh: only what deploy/quickstart.sh does
  ARGUMENTS       for tests/run.sh in the root (--no-sanitizers)
Needs root, debootstrap and the network. Builds a copy of this tree; nothing outside of FOLDER is changed.
TEXT
}
cache=/var/cache/quoin-debian13
mirror=
quick=false
arguments=(--no-sanitizers)
while [[ $# -gt 0 ]]; do
  case $1 in
    --cache) cache=${2:?a folder}; shift 2 ;;
    --mirror) mirror=${2:?a URL}; shift 2 ;;
    --quick) quick=true; shift ;;
    --) shift; arguments=("$@"); break ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done
if [[ $(id -u) -ne 0 ]]; then
  echo "debian13.sh: needs to be root: debootstrap and chroot do" >&2
  exit 1
fi
if ! command -v debootstrap >/dev/null; then
  echo "debian13.sh: needs debootstrap (apt-get install debootstrap)" >&2
  exit 1
fi
if [[ -z $mirror ]]; then
  # shellcheck disable=SC2016
  mirror=$(apt-get indextargets --format '$(REPO_URI)' | grep -v security | sort -u | head -n 1)
fi
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

make_root() {
  if [[ -e $cache/complete ]]; then
    echo "$root is there"
    return
  fi
  rm -rf --one-file-system "$root"
  debootstrap --variant=minbase trixie "$root" "$mirror" >"$cache/debootstrap.log" || {
    tail -n 20 "$cache/debootstrap.log" >&2
    return 1
  }
  touch "$cache/complete"
}

# All that git knows or would know, with its times: what is built already stays built.
copy_sources() {
  mkdir -p "$root/quoin"
  find "$root/quoin" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
  git -C "$source" -c safe.directory='*' ls-files --cached --others --exclude-standard -z |
    (cd "$source" && while IFS= read -r -d '' file; do [[ ! -e $file ]] || printf '%s\0' "$file"; done) |
    tar --create --directory="$source" --null --files-from=- | tar --extract --directory="$root/quoin"
}

# In mount and process namespaces of its own: what is mounted and started there ends with it.
# shellcheck disable=SC2016
inside() {
  unshare --mount --pid --fork --kill-child bash -c '
    root=$1
    shift
    mount -t proc proc "$root/proc"
    mount --bind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    mount -t tmpfs tmpfs "$root/dev/shm"
    cp /etc/resolv.conf "$root/etc/resolv.conf"
    exec chroot "$root" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
      CCACHE_DIR=/var/cache/ccache "$@"' _ "$root" "$@"
}

step "root" make_root
step "copy of the sources" copy_sources
step "deploy/quickstart.sh" inside /quoin/deploy/quickstart.sh --duration 20 --json
$quick || step "tests/run.sh" inside /quoin/tests/run.sh "${arguments[@]}"
