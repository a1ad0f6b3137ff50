#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs the Debian packages that are missing of packages.txt, or of the lists that are given. Asks
# nothing, and does nothing when all are there.
set -eu

folder=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
if [ $# -eq 0 ]; then
  set -- "$folder/packages.txt"
fi

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "install_packages.sh: needs Debian's dpkg-query and apt-get; elsewhere install what" \
    "these files name: $*" >&2
  exit 1
fi

is_installed() {
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null || true)
  # A package for several architectures answers once for each.
  case $status in
    installed*) return 0 ;;
    *) return 1 ;;
  esac
}

missing=
# Lines "name | other name" become words "name|other".
for names in $(cat -- "$@" | sed 's/#.*//; s/ *| */|/g'); do
  installed=false
  for package in $(echo "$names" | tr '|' ' '); do
    if is_installed "$package"; then installed=true; fi
  done
  if ! $installed; then missing="$missing $names"; fi
done
if [ -z "$missing" ]; then
  exit 0
fi

if [ "$(id -u)" -eq 0 ]; then
  as_root=
elif command -v sudo >/dev/null; then
  as_root=sudo
else
  echo "install_packages.sh: neither root nor sudo; have these packages installed:$missing" >&2
  exit 1
fi

# The words are meant to be split: a list of packages, and perhaps no sudo.
# shellcheck disable=SC2086
$as_root apt-get update --quiet
wanted=
for names in $missing; do
  chosen=
  for package in $(echo "$names" | tr '|' ' '); do
    if [ -z "$chosen" ] && apt-cache show "$package" >/dev/null 2>&1; then chosen=$package; fi
  done
  # Where there is none, apt-get says so.
  wanted="$wanted ${chosen:-${names%%|*}}"
done
echo "Installing:$wanted"
# shellcheck disable=SC2086
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install --quiet --yes --no-install-recommends $wanted
