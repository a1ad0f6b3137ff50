# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0

cmake_minimum_required(VERSION 3.25)

# Writes a C++ file that defines quoin::topics::idl_files().
#   cmake -D FOLDER=idl -D OUTPUT=idl_files.cpp -P embed_idl.cmake
file(GLOB paths ${FOLDER}/*.idl)
set(rows "")
foreach(path IN LISTS paths)
  cmake_path(GET path FILENAME name)
  file(READ ${path} text)
  set(included "")
  while(text MATCHES "#include \"([^\"\n]+)\"[^\n]*\n")
    set(line "${CMAKE_MATCH_0}")
    set(file "${CMAKE_MATCH_1}")
    set(insertion "")
    if(NOT file IN_LIST included)
      list(APPEND included ${file})
      file(READ ${FOLDER}/${file} insertion)
    endif()
    string(REPLACE "${line}" "${insertion}" text "${text}")
  endwhile()
  string(APPEND rows "    {\"${name}\", R\"idl(${text})idl\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"services/topics/topic_types.hpp\"

namespace quoin::topics {

std::span<const IdlFile> idl_files() {
  static constexpr IdlFile files[] = {
${rows}  };
  return files;
}

}  // namespace quoin::topics
")
