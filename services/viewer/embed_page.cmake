# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0

cmake_minimum_required(VERSION 3.25)

# Writes a C++ file that defines quoin::viewer::page_files(). Texts are cut up: a literal has its limits.
#   cmake -D FOLDER=page -D OUTPUT=page_files.cpp -P embed_page.cmake
set(types_html "text/html; charset=utf-8")
set(types_css "text/css; charset=utf-8")
set(types_js "text/javascript; charset=utf-8")
file(GLOB paths ${FOLDER}/*.html ${FOLDER}/*.css ${FOLDER}/*.js)
set(rows "")
foreach(path IN LISTS paths)
  cmake_path(GET path FILENAME name)
  cmake_path(GET path EXTENSION LAST_ONLY extension)
  string(SUBSTRING ${extension} 1 -1 extension)
  set(url "/${name}")
  if(name STREQUAL "index.html")
    set(url "/")
  endif()
  file(READ ${path} hex HEX)
  string(LENGTH ${hex} length)
  set(literals "")
  set(begin 0)
  while(begin LESS length)
    string(SUBSTRING ${hex} ${begin} 8000 part)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" part ${part})
    string(APPEND literals "\n        \"${part}\"")
    math(EXPR begin "${begin} + 8000")
  endwhile()
  math(EXPR bytes "${length} / 2")
  string(APPEND rows "      {\"${url}\", \"${types_${extension}}\", std::string_view(${literals},\n        ${bytes})},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"services/viewer/page.hpp\"

namespace quoin::viewer {

std::span<const PageFile> page_files() {
  static constexpr PageFile files[] = {
${rows}  };
  return files;
}

}  // namespace quoin::viewer
")
