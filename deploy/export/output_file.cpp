// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/export/output_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "services/files/atomic_file.hpp"

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
  int error = 0;
  const auto kind = std::filesystem::status(file).type();
  if (kind == std::filesystem::file_type::character || kind == std::filesystem::file_type::fifo) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (stream) return;
    error = errno;
  } else {
    error = write_atomically(file, text, 0644);
    if (error == 0) return;
  }
  throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(error));
}

}  // namespace quoin::deploy
