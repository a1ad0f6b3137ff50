#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Who may know whom. Prints each violation and fails when there is one.
#   check.sh SOURCE_TREE
set -u
cd "${1:?source tree}" || exit 2
violations=0

# deny FOLDER PATTERN WHY [EXCEPT]: no source file below FOLDER includes what PATTERN (an extended
# regular expression on the include's path) matches, but for lines "file:line:#include ..." that
# match EXCEPT.
deny() {
  local found
  found=$(grep -rnE --include='*.[ch]pp' --include='*.[ch]' "^#include [<\"]($2)" "$1" |
    grep -vE "${4:-^$}") || return 0
  printf '%s\n%s\n' "$3:" "$found"
  violations=$((violations + 1))
}

dds='fastdds|fastrtps|fastcdr|.*PubSubTypes\.h'
deny core "$dds|idl/|yaml-cpp|fstream|iostream|spdlog|services/|deploy/|sensor_bridge/" \
  "core/ knows no DDS, no YAML, no files and nobody else"
deny sensor_bridge "$dds|spdlog" "sensor_bridge/ reaches DDS through the service kit only"
deny sensor_bridge/rplidar/protocol '(core|idl|services|deploy|sensor_bridge|sys)/|iostream|fstream|unistd' \
  "the RPLIDAR protocol knows nobody and does no input or output" \
  'sensor_bridge/rplidar/protocol/[a-z_]+\.hpp"$'
deny sensor_bridge/transport 'core/|deploy/|idl/|services/|sensor_bridge/(rplidar|recordings|replay|simulated)/' \
  "the transport knows no device and no format"
deny sensor_bridge/recordings 'deploy/|idl/|services/|sensor_bridge/(rplidar|simulated|transport)/' \
  "file formats know no device and no message, but for the bytes of scans" \
  '^sensor_bridge/recordings/(laser_scan|odometry)_message\.cpp:.*services/topics/cdr_cursor\.hpp"$|services/files/regular_file\.hpp"$'
deny sensor_bridge/message_files 'deploy/|idl/|services/|sensor_bridge/(recordings|rplidar|simulated|transport)/' \
  "containers of messages know no message" 'services/files/regular_file\.hpp"$'
deny sensor_bridge/rplidar/driver 'core/|deploy/|idl/|services/|sensor_bridge/rplidar/emulator' \
  "the RPLIDAR driver knows protocol and transport"
deny sensor_bridge/rplidar/emulator 'deploy/|idl/|services/|sensor_bridge/(rplidar/driver|transport)' \
  "the RPLIDAR emulator knows the protocol and simulated worlds" 'sensor_bridge/transport/file_descriptor\.hpp"$'
deny deploy "$dds" "deploy/ reaches DDS through the service kit only"
deny deploy 'core/(segmentation|fitting|corners|circles)/' "deploy/ reaches methods through the method lists" \
  'core/(segmentation/segment(ers)?|fitting/fit(ters)?|corners/corner_finders?|circles/circle_fit(ters)?)\.hpp'
# `quoin evaluate` is there to run methods; what starts and watches processes runs none.
deny deploy 'core/(evaluation/((circle_)?consistency|loop_coverage|segmentation_quality)|extraction|simulation)' \
  "deploy/ runs no methods outside deploy/evaluation" '^deploy/(evaluation|examples/library)/'
deny deploy/evaluation 'deploy/(orchestration|command|diagnostics)/|idl/|services/(runtime|topics|keys)/' \
  "the evaluation needs no DDS and no deployment"
deny deploy/diagnostics 'idl/|services/(runtime|topics)/|deploy/(orchestration|command)/' \
  "the doctor is told what was heard on the network"
deny services/deployment 'idl/|services/(keys|runtime)/' "the deployment reader needs no DDS"
deny services/keys 'idl/|services/(topics|runtime)/|yaml-cpp' "what makes keys needs no DDS"
deny services/runtime/node "$dds|CLI/|sys/" "a node knows no process and no Fast DDS"
deny services/topics "$dds|services/runtime/" "topics need no DDS; one file knows its serialisation" \
  '^services/topics/cdr_codec\.cpp:.*<fastcdr/'
deny services 'fastdds|fastrtps|.*PubSubTypes\.h' "only services/runtime/dds names Fast DDS" \
  '^services/runtime/dds/'
for file in topic_types cdr_json idl_parser message_text; do
  deny "services/topics/$file.hpp" 'idl/' "the table, JSON and text need no generated code"
  deny "services/topics/$file.cpp" 'idl/' "the table, JSON and text need no generated code"
done
for main in services/*/main.cpp; do
  deny "$(dirname "$main")" "$dds|yaml-cpp|deploy/|sensor_bridge/" "a service knows core, idl and the service kit" \
    '^services/recorder/.*sensor_bridge/message_files/'
done
deny tests/interoperability 'core/|deploy/|idl/|sensor_bridge/|services/|tests/' \
  "the programs of another DDS know nothing but our IDL files"
deny services/runtime 'core/(segmentation|fitting|corners|circles|simulation)|sensor_bridge/' \
  "the service kit knows no algorithm"

sources() {
  find CMakeLists.txt core deploy idl sensor_bridge services tests -name node_modules -prune -o -type f \( "$@" \) -print
}

missing=$(sources -name '*.[ch]pp' -o -name '*.[ch]' -o -name '*.idl' -o -name '*.sh' -o -name CMakeLists.txt -o -name '*.yaml' -o -name '*.js' -o -name '*.mjs' -o -name '*.css' |
  grep -v '^tests/services/deployment/malformed/' | xargs grep -LE 'SPDX-License-Identifier: Apache-2\.0')
if [[ -n $missing ]]; then
  printf 'no SPDX header:\n%s\n' "$missing"
  violations=$((violations + 1))
fi

if grep -HnE 'MODE="0?[0-7]{2}[2367]"' deploy/udev/*.rules; then
  echo "devices are not for everybody to write"
  violations=$((violations + 1))
fi

large=$(find core deploy sensor_bridge services -name main.cpp | xargs wc -l | awk '$2 != "total" && $1 > 60')
if [[ -n $large ]]; then
  printf 'a main file names input, output and function; these are too long:\n%s\n' "$large"
  violations=$((violations + 1))
fi

((violations == 0)) || { echo "$violations rules broken"; exit 1; }
echo "all rules kept"
