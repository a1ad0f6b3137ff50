#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# What the configure step says of each Fast DDS that may be there, and of none: with fakes, which have nothing but a version.
#   fakes.sh SOURCE_TREE
set -euo pipefail
source=$(cd "${1:?source tree}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

mkdir "$work/project"
cat >"$work/project/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.25)
project(fakes LANGUAGES NONE)
foreach(places CMAKE_SYSTEM_PATH SYSTEM_ENVIRONMENT_PATH CMAKE_ENVIRONMENT_PATH PACKAGE_REGISTRY)
  set(CMAKE_FIND_USE_\${places} OFF)  # what is installed is not to be found
endforeach()
include("$source/idl/fast_dds.cmake")
message(STATUS "chosen: \${QUOIN_FAST_DDS} \${QUOIN_FAST_DDS_MAJOR}")
CMAKE

# fake FOLDER PACKAGE VERSION
fake() {
  local folder=$work/$1/lib/cmake/$2
  mkdir -p "$folder"
  printf 'set(PACKAGE_VERSION %s)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n' "$3" >"$folder/$2-config-version.cmake"
  echo "set($2_FOUND TRUE)" >"$folder/$2-config.cmake"
}

# configure FOLDER: with nothing to be found but what is in there.
configure() {
  local folder=$work/$1
  rm -rf "$work/build"
  cmake -S "$work/project" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$folder" 2>&1 | tr '\n' ' ' | tr -s ' '
}

failures=0
# expect FOLDER TEXT...: the configure step prints each of them.
expect() {
  local output text
  output=$(configure "$1" || true)
  for text in "${@:2}"; do
    if [[ $output != *"$text"* ]]; then
      printf '%s: no "%s" in: %s\n' "$1" "$text" "$output"
      failures=$((failures + 1))
    fi
  done
}

# expect_not FOLDER TEXT
expect_not() {
  if [[ $(configure "$1" || true) == *"$2"* ]]; then
    printf '%s: "%s"\n' "$1" "$2"
    failures=$((failures + 1))
  fi
}

known=("Fast DDS 3.1, of Debian 13: apt-get install libfastdds-dev" "Fast DDS 2.9, of Debian 12: apt-get install libfastrtps-dev")
whole() {
  fake "$1" fastcdr 1
  mkdir -p "$work/$1/bin"
  printf '#!/bin/sh\n' >"$work/$1/bin/fastddsgen"
  chmod +x "$work/$1/bin/fastddsgen"
}

mkdir "$work/none"
expect none "There is no Fast DDS" "${known[@]}" "-DQUOIN_DDS=OFF"
fake later fastdds 4.0.0 && whole later
expect later "Fast DDS 4.0.0 ($work/later/lib/cmake/fastdds) is not known" "${known[@]}"
fake earlier fastrtps 2.6.2 && whole earlier
expect earlier "Fast DDS 2.6.2" "is not known" "${known[@]}"
fake near fastrtps 2.14.1 && whole near
expect near "CMake Warning" "Fast DDS 2.14.1" "was never tried" "${known[@]}" "chosen: fastrtps 2"
fake bare fastdds 3.1.2
expect bare "not all that belongs to it" "${known[@]}"
fake debian_12 fastrtps 2.9.1 && whole debian_12
expect debian_12 "chosen: fastrtps 2"
expect_not debian_12 "CMake Warning"
fake debian_13 fastdds 3.1.2 && whole debian_13
expect debian_13 "chosen: fastdds 3"
expect_not debian_13 "CMake Warning"
[[ $failures -eq 0 ]]
