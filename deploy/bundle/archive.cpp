// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/bundle/archive.hpp"

#include <array>
#include <cstdio>
#include <ctime>
#include <stdexcept>

#include <zlib.h>

namespace quoin::deploy {

namespace {

constexpr std::size_t block = 512;  // bytes: of what a tar archive is made

/// The header of a file: fields of fixed width, numbers in octal digits.
std::string header(const ArchivedFile& file, std::time_t time) {
  if (file.name.size() > 99) throw std::invalid_argument("name too long: " + file.name);
  std::string text(block, '\0');
  const auto put = [&text](std::size_t at, const std::string& value) {
    text.replace(at, value.size(), value);
  };
  const auto octal = [](unsigned long long value, int digits) {
    std::array<char, 24> number{};
    std::snprintf(number.data(), number.size(), "%0*llo", digits, value);
    return std::string(number.data());
  };
  put(0, file.name);
  put(100, octal(0600, 7));
  put(108, octal(65534, 7));
  put(116, octal(65534, 7));
  put(124, octal(file.content.size(), 11));
  put(136, octal(static_cast<unsigned long long>(time), 11));
  put(148, "        ");  // counts as blanks in its own sum
  put(156, "0");
  put(257, std::string("ustar\0"
                       "00",
                       8));
  unsigned sum = 0;
  for (const char character : text) sum += static_cast<unsigned char>(character);
  put(148, octal(sum, 6) + '\0');
  return text;
}

std::string compressed(const std::string& text) {
  z_stream stream{};
  constexpr int gzip_window = 15 + 16;
  if (::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip_window, 8,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  std::string result(::deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  ::deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  ::deflateEnd(&stream);
  return result;
}

}  // namespace

std::string tar_gz(const std::vector<ArchivedFile>& files) {
  const std::time_t now = std::time(nullptr);
  std::string archive;
  for (const ArchivedFile& file : files) {
    archive += header(file, now) + file.content;
    archive.resize((archive.size() + block - 1) / block * block, '\0');
  }
  archive.resize(archive.size() + 2 * block, '\0');
  return compressed(archive);
}

}  // namespace quoin::deploy
