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

missing=
for package in $(cat -- "$@" | sed 's/#.*//'); do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  # A package for several architectures answers once for each.
  case $status in
    installed*) ;;
    *) missing="$missing $package" ;;
  esac
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

echo "Installing:$missing"
# The words are meant to be split: a list of packages, and perhaps no sudo.
# shellcheck disable=SC2086
$as_root apt-get update --quiet
# shellcheck disable=SC2086
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install --quiet --yes --no-install-recommends $missing
