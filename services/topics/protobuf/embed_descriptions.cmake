# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0

# Writes a C++ file that defines quoin::topics::embedded_descriptions() with the bytes of a file.
#   cmake -D INPUT=descriptions.bin -D OUTPUT=descriptions.cpp -P embed_descriptions.cmake
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1, " bytes "${bytes}")
file(WRITE ${OUTPUT} "#include <span>

namespace quoin::topics {

std::span<const unsigned char> embedded_descriptions() {
  static constexpr unsigned char bytes[] = {
${bytes}};
  return bytes;
}

}  // namespace quoin::topics
")
