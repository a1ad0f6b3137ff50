# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0

cmake_minimum_required(VERSION 3.25)

# Writes a C++ file that defines quoin::ros2::own_definitions().
#   cmake -D FOLDER=idl/ros2/quoin_msgs/msg -D OUTPUT=own_definitions.cpp -P embed_definitions.cmake
file(GLOB paths ${FOLDER}/*.msg)
set(rows "")
foreach(path IN LISTS paths)
  cmake_path(GET path STEM name)
  file(READ ${path} text)
  string(APPEND rows "    {\"quoin_msgs/${name}\", R\"msg(${text})msg\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"services/ros2/definitions.hpp\"

namespace quoin::ros2 {

std::span<const Definition> own_definitions() {
  static constexpr Definition definitions[] = {
${rows}  };
  return definitions;
}

}  // namespace quoin::ros2
")
