#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# make_idl.sh NODE_MODULES OUTPUT.idl OWN_PACKAGE TYPE...: IDL of messages of ROS 2 by ROS 2's own tool (rosidl), all in one
# file: of the types named, by the definitions of an npm package, and of those in the folder OWN_PACKAGE.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
modules=$1 output=$2 own=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

node "$here/write_messages.mjs" "$modules" "$work/msg" "$@" >"$work/list"
if [[ -d $own ]]; then
  package=$(basename "$own")
  mkdir -p "$work/msg/$package/msg"
  # Without comments, which would become annotations that other compilers of IDL do not know.
  for file in "$own"/msg/*.msg; do sed 's/#.*//' "$file" >"$work/msg/$package/msg/${file##*/}"; done
  # Each behind those that it needs.
  grep -o 'msg/[A-Za-z0-9]*\.msg' "$own/CMakeLists.txt" | sed "s|msg/\(.*\)\.msg|$package \1|" >>"$work/list"
fi
for package in $(cut -d' ' -f1 "$work/list" | sort -u); do
  files=()
  while read -r of name; do
    if [[ $of == "$package" ]]; then files+=("$work/msg/$package:msg/$name.msg"); fi
  done <"$work/list"
  rosidl translate --to idl -o "$work/idl/$package" "$package" "${files[@]}" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
done
while read -r package name; do
  grep -v '^#include' "$work/idl/$package/msg/$name.idl"
done <"$work/list" |
  awk '!(/^ *typedef/ && seen[$0]++)' >"$output"  # of arrays, in each file anew
