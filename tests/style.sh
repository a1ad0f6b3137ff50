#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Format of all sources by .clang-format, and checks of the product's sources by .clang-tidy.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() {
  cat <<'TEXT'
usage: tests/style.sh format|tidy
  format   fails when clang-format would change a file (clang-format-14 -i FILE changes it)
  tidy     fails when clang-tidy finds something; takes some minutes
TEXT
}

sources() { find core deploy sensor_bridge services tests -path tests/npm/node_modules -prune -o -name '*.[ch]pp' -type f -print; }

case ${1-} in
  format) sources | xargs clang-format-14 --dry-run --Werror ;;
  tidy)
    cmake --preset tidy >/dev/null
    # What is generated: the messages, the IDL texts, the page.
    cmake --build build/tidy -j "$(nproc)" --target quoin_idl quoin_ros2_idl quoin_topic_types quoin_foxglove quoin_viewer_page >/dev/null
    run-clang-tidy-14 -quiet -p build/tidy -j "$(nproc)" '^(?!.*/idl/|.*idl_files|.*/generated/|.*descriptions.cpp|.*own_definitions.cpp|.*page_files.cpp).*$' 2>/dev/null |
      { grep -vE '^$|^clang-tidy-14 |warnings generated|^Suppressed|^Use -header-filter' || true; }
    # The exit status is that of run-clang-tidy: pipefail.
    ;;
  -h | --help) usage ;;
  *) usage >&2; exit 2 ;;
esac
