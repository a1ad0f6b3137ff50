#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds deploy/examples/library against an installed library, and against these sources; runs it.
#   library.sh SOURCE_TREE BUILD_TREE
set -euo pipefail
sources=${1:?source tree}
build=${2:?build tree}
example=$sources/deploy/examples/library
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "library.sh: $*" >&2
  exit 1
}

# build NAME ARGUMENTS...: the example in a tree of this name.
build() {
  cmake -S "$example" -B "$work/$1" -G Ninja -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "${@:2}" >"$work/log" 2>&1 &&
    nice cmake --build "$work/$1" >>"$work/log" 2>&1 || {
    cat "$work/log"
    fail "$1: does not build"
  }
}

# C++20 comes with the library, what it is warned of does not.
no_warnings_carried() {
  if grep -F '/corners.cpp' "$work/$1/compile_commands.json" | grep -qE 'Wshadow|Werror='; then fail "$1: warnings are carried"; fi
}

# check NAME: what the program of that tree prints are the walls and corners of its room.
check() {
  "$work/$1/corners" >"$work/$1.txt" || fail "$1: the program fails"
  [[ $(grep -c '^wall ' "$work/$1.txt") -eq 4 ]] || fail "$1: not four walls: $(cat "$work/$1.txt")"
  [[ $(grep -cE '^corner \(-?2\.000, -?1\.500\) m' "$work/$1.txt") -eq 4 ]] || fail "$1: not four corners: $(cat "$work/$1.txt")"
  no_warnings_carried "$1"
  echo "$1: ok"
}

cmake --install "$build" --component library --prefix "$work/prefix" >/dev/null
if find "$work/prefix" -type f | grep -vE '/include/quoin/core/.*\.hpp$|/libquoin_core\.a$|/cmake/quoin/quoin[A-Za-z-]*\.cmake$|/share/doc/libquoin-dev/|\.(idl|proto)$'; then
  fail "installed beside the library"
fi
if grep -rF -e "$sources" -e "$build" "$work/prefix" --include='*.cmake'; then fail "the package names the tree that it was built in"; fi

build installed -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release
check installed

# Matrices that are aligned otherwise than the library's are an error that says so.
build misaligned -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_FLAGS=-DEIGEN_MAX_STATIC_ALIGN_BYTES=32
if "$work/misaligned/corners" 2>"$work/errors"; then fail "other alignment is not noticed"; fi
grep -q 'EIGEN_MAX_STATIC_ALIGN_BYTES' "$work/errors" || fail "other alignment: $(cat "$work/errors")"

# The next minor version is another interface.
sed 's/find_package(quoin 0.1 /find_package(quoin 0.2 /' "$example/CMakeLists.txt" >"$work/CMakeLists.txt"
cp "$example/corners.cpp" "$work"
if cmake -S "$work" -B "$work/later" -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/log" 2>&1; then fail "a later version is found"; fi

if command -v clang++-14 >/dev/null; then
  build clang -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_CXX_FLAGS='-Wall -Wextra -Werror'
  check clang
else
  echo "clang: skipped, there is no clang++-14"
fi

# As part of another project: that it is configured without anything but Eigen, and compiles. The whole library would take
# minutes, and is the one above.
cmake -S "$example" -B "$work/subdirectory" -G Ninja -DQUOIN_SOURCES="$sources" -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_DISABLE_FIND_PACKAGE_yaml-cpp=ON -DCMAKE_DISABLE_FIND_PACKAGE_fastrtps=ON >"$work/log" 2>&1 &&
  nice ninja -C "$work/subdirectory" CMakeFiles/corners.dir/corners.cpp.o \
    quoin/core/CMakeFiles/quoin_core.dir/extraction/feature_extractor.cpp.o >>"$work/log" 2>&1 || {
  cat "$work/log"
  fail "subdirectory: does not build"
}
no_warnings_carried subdirectory
echo "subdirectory: ok"
