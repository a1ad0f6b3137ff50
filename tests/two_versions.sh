#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Deployments of which some processes are those of this machine and the others those of another Debian in a chroot: each
# link between two processes is between two versions of Fast DDS, in both directions. Fails when a scan is not accounted for at
# a stage, or none arrives. On loopback, in a network namespace of its own. Without security: with it Fast DDS 2.9 and 3.1
# refuse each other.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  cat <<'TEXT'
usage: tests/two_versions.sh [--root FOLDER] [--here FOLDER] [--there FOLDER] [--seconds N]
  --root FOLDER   root of the other Debian (/var/cache/quoin-debian13/root, of tests/debian13.sh)
  --there FOLDER  programs in it (/quoin/build/bin)
  --here FOLDER   programs of this machine (build/bin of this tree)
  --seconds N     how long each of the two deployments runs (20)
Needs to be root.
TEXT
}
root=/var/cache/quoin-debian13/root
there=/quoin/build/bin
here=$source/build/bin
seconds=20
while [[ $# -gt 0 ]]; do
  case $1 in
    --root) root=${2:?a folder}; shift 2 ;;
    --there) there=${2:?a folder}; shift 2 ;;
    --here) here=${2:?a folder}; shift 2 ;;
    --seconds) seconds=${2:?a number}; shift 2 ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done
if [[ $(id -u) -ne 0 ]]; then
  echo "two_versions.sh: needs to be root: unshare and chroot do" >&2
  exit 1
fi
programs=(quoin-simulated quoin-segmentation quoin-line-fitting quoin-corner-estimation)
for program in "${programs[@]}"; do
  for file in "$here/$program" "$root$there/$program" "$here/quoin"; do
    [[ -x $file ]] || { echo "two_versions.sh: $file is not there" >&2; exit 1; }
  done
done

# Namespaces of mounts, processes and network: what is mounted and started ends with them.
if [[ ${QUOIN_TWO_VERSIONS-} != inside ]]; then
  export QUOIN_TWO_VERSIONS=inside
  work=$(mktemp -d)  # at the same path here and there
  trap 'rmdir "$root$work"; rm -rf "$work"' EXIT
  mkdir -p "$root$work"
  QUOIN_WORK=$work unshare --mount --pid --net --fork --kill-child "$0" --root "$root" --there "$there" --here "$here" --seconds "$seconds"
  exit
fi
work=$QUOIN_WORK
ip link set lo up
mount -t proc proc /proc
mount -t proc proc "$root/proc"
mount --bind "$work" "$root$work"
mountpoint -q "$root/dev" || mount --rbind /dev "$root/dev"

# place FOLDER PROGRAM...: those programs are of the other Debian, the rest of this one.
place() {
  local folder=$1 program
  mkdir -p "$folder"
  cp "$here/quoin" "$folder"  # it starts the programs beside itself
  for program in "${programs[@]}"; do ln -s "$here/$program" "$folder/$program"; done
  for program in "${@:2}"; do
    rm "$folder/$program"
    printf '#!/bin/sh\nexec chroot %s %s/%s "$@"\n' "$root" "$there" "$program" >"$folder/$program"
    chmod +x "$folder/$program"
  done
}

# run NAME FOLDER
run() {
  local folder=$work/$1
  mkdir "$folder"
  cat >"$folder/deployment.yaml" <<'YAML'
version: 1
namespace: two_versions
services:
  - {name: front, kind: simulated, parameters: {environment: domestic_room, rate_hz: 20}}
  - {name: walls, kind: segmentation, input: front}
  - {name: lines, kind: line_fitting, input: walls}
  - {name: corners, kind: corner_estimation, input: lines}
YAML
  if ! "$2/quoin" up "$folder/deployment.yaml" --duration "$seconds" --json >"$folder/report.json" 2>"$folder/log"; then
    echo "$1: quoin up failed:"
    cat "$folder/log"
    return 1
  fi
  python3 - "$1" "$folder/report.json" <<'PYTHON' || { cat "$folder/log"; return 1; }
import json, sys
report = json.load(open(sys.argv[2]))
sent = report["scans_published"]
stages = {name: report["services"][name] for name in ("walls", "lines", "corners")}
print(f"{sys.argv[1]}: {sent} scans,", ", ".join(
    f"{name} {stage['received']} + {stage['lost'] + stage['upstream_lost']} lost" for name, stage in stages.items()))
exact = all(stage["received"] + stage["lost"] + stage["upstream_lost"] == sent and stage["restarts"] == 0
            and stage["received"] > 0 for stage in stages.values())
sys.exit(0 if exact and sent > 0 else 1)
PYTHON
}

place "$work/odd" quoin-simulated quoin-line-fitting
place "$work/even" quoin-segmentation quoin-corner-estimation
run "source there, next here" "$work/odd"
run "source here, next there" "$work/even"
