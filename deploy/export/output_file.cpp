// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/export/output_file.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

namespace quoin::deploy {

bool may_replace(const std::filesystem::path& file) {
  if (!std::filesystem::exists(std::filesystem::symlink_status(file))) return true;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(file))) return false;
  std::string first(std::strlen(export_marker), '\0');
  std::ifstream(file, std::ios::binary)
      .read(first.data(), static_cast<std::streamsize>(first.size()));
  return first == export_marker;
}

void write_whole(const std::filesystem::path& file, const std::string& text) {
  const auto fail = [&](const char* what) {
    throw std::runtime_error(file.string() + ": " + what + ": " + std::strerror(errno));
  };
  const auto kind = std::filesystem::status(file).type();
  if (kind == std::filesystem::file_type::character || kind == std::filesystem::file_type::fifo) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) fail("cannot be written");
    return;
  }
  std::string temporary = file.string() + ".XXXXXX";
  const int descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (descriptor < 0) fail("cannot be written");
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = ::write(descriptor, text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    written += static_cast<std::size_t>(count);
  }
  const bool whole = written == text.size() && ::fchmod(descriptor, 0644) == 0;
  const bool closed = ::close(descriptor) == 0;
  if (whole && closed && ::rename(temporary.c_str(), file.c_str()) == 0) return;
  const int error = errno;
  ::unlink(temporary.c_str());
  errno = error;
  fail("cannot be written");
}

}  // namespace quoin::deploy
