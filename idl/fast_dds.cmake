# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Finds the Fast DDS that Quoin is built with: QUOIN_FAST_DDS is its target, QUOIN_FAST_DDS_MAJOR its major version. Where
# there is none that is known, the error says which are, and what to install.

# No version asked for: the error names the one that is there.
find_package(fastdds QUIET)
if(NOT fastdds_FOUND)
  find_package(fastrtps QUIET)  # as it was called before version 3
endif()

if(fastdds_FOUND)
  set(quoin_found "${fastdds_VERSION}")
  set(quoin_found_in "${fastdds_DIR}")
elseif(fastrtps_FOUND)
  set(quoin_found "${fastrtps_VERSION}")
  set(quoin_found_in "${fastrtps_DIR}")
endif()

cmake_host_system_information(RESULT quoin_system QUERY DISTRIB_PRETTY_NAME)
if(NOT quoin_system)
  set(quoin_system "${CMAKE_HOST_SYSTEM_NAME}")
endif()
string(CONCAT quoin_known
  "Quoin is built and tested with\n"
  "  Fast DDS 3.1, of Debian 13: apt-get install libfastdds-dev libfastcdr-dev fastddsgen\n"
  "  Fast DDS 2.9, of Debian 12: apt-get install libfastrtps-dev libfastcdr-dev fastddsgen\n"
  "deploy/install_packages.sh installs them with all else. This is ${quoin_system}: elsewhere than on Debian 12 and 13 build in a "
  "container of one of them, or install one of these versions of Fast DDS with its Fast CDR and Fast DDS-Gen, and say where by "
  "-DCMAKE_PREFIX_PATH=FOLDER. -DQUOIN_DDS=OFF builds what needs none.")

if(fastdds_FOUND AND fastdds_VERSION VERSION_GREATER_EQUAL 3 AND fastdds_VERSION VERSION_LESS 4)
  set(QUOIN_FAST_DDS_MAJOR 3)
  set(QUOIN_FAST_DDS fastdds)
elseif(fastrtps_FOUND AND fastrtps_VERSION VERSION_GREATER_EQUAL 2.9 AND fastrtps_VERSION VERSION_LESS 3)
  set(QUOIN_FAST_DDS_MAJOR 2)
  set(QUOIN_FAST_DDS fastrtps)
elseif(quoin_found)
  message(FATAL_ERROR "Fast DDS ${quoin_found} (${quoin_found_in}) is not known. ${quoin_known}")
else()
  message(FATAL_ERROR "There is no Fast DDS. ${quoin_known}")
endif()
if(NOT quoin_found MATCHES "^(2\\.9|3\\.1)(\\.|$)")
  message(WARNING "Fast DDS ${quoin_found} (${quoin_found_in}) is near to what is known, and was never tried. ${quoin_known}")
endif()

find_package(fastcdr QUIET)
find_program(FASTDDSGEN fastddsgen)
if(NOT fastcdr_FOUND OR NOT FASTDDSGEN)
  message(FATAL_ERROR "Fast DDS ${quoin_found} is there, but not all that belongs to it (Fast CDR: ${fastcdr_DIR}, generator: "
                      "${FASTDDSGEN}). ${quoin_known}")
endif()
