// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/message_files/binary_file.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "services/files/regular_file.hpp"

namespace quoin::sensor_bridge {

BinaryFile::BinaryFile(const std::filesystem::path& file) : name_(file.string()) {
  const RegularFile opened = open_regular(file);
  if (opened.descriptor < 0) {
    throw ScanFileError("cannot read scan file '" + name_ + "': " + opened.problem);
  }
  descriptor_ = opened.descriptor;
  size_ = opened.size;
}

BinaryFile::~BinaryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

BinaryFile::BinaryFile(BinaryFile&& other) noexcept
    : name_(std::move(other.name_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

BinaryFile& BinaryFile::operator=(BinaryFile&& other) noexcept {
  std::swap(name_, other.name_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  return *this;
}

void BinaryFile::read(std::uint64_t offset, std::size_t count, std::string& out) const {
  if (!holds(offset, count)) {
    fail(offset, "the file ends here, " +
                     std::to_string(count - (size_ - std::min(offset, size_))) +
                     " bytes early; it was cut off");
  }
  out.resize(count);
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got =
        ::pread(descriptor_, out.data() + done, count - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(offset + done, "cannot read on: " + std::generic_category().message(errno));
    if (got == 0) fail(offset + done, "the file ends here; it became shorter meanwhile");
    done += static_cast<std::size_t>(got);
  }
}

std::string BinaryFile::beginning(std::size_t count) const {
  std::string bytes;
  read(0, static_cast<std::size_t>(std::min<std::uint64_t>(count, size_)), bytes);
  return bytes;
}

void BinaryFile::fail(std::uint64_t offset, const std::string& what) const {
  throw ScanFileError(name_ + ": byte " + std::to_string(offset) + ": " + what);
}

}  // namespace quoin::sensor_bridge
