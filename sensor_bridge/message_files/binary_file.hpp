// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "sensor_bridge/message_files/scan_file_error.hpp"

namespace quoin::sensor_bridge {

/// A file of known size that is read from anywhere; never the whole of it in memory.
class BinaryFile {
 public:
  /// Throws ScanFileError when the file cannot be opened or is a folder.
  explicit BinaryFile(const std::filesystem::path& file);
  ~BinaryFile();
  BinaryFile(BinaryFile&& other) noexcept;
  BinaryFile& operator=(BinaryFile&& other) noexcept;

  [[nodiscard]] const std::string& name() const { return name_; }
  /// [byte] when it was opened
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Whether `count` bytes from `offset` on are in the file.
  [[nodiscard]] bool holds(std::uint64_t offset, std::uint64_t count) const {
    return offset <= size_ && count <= size_ - offset;
  }
  /// Replaces `out` with `count` bytes from `offset` on. Throws ScanFileError when they are not
  /// there.
  void read(std::uint64_t offset, std::size_t count, std::string& out) const;
  /// The first bytes, `count` at most.
  [[nodiscard]] std::string beginning(std::size_t count) const;

  /// Throws ScanFileError for the byte at `offset`.
  [[noreturn]] void fail(std::uint64_t offset, const std::string& what) const;

 private:
  std::string name_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace quoin::sensor_bridge
