// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sensor_bridge/message_files/scan_file_error.hpp"

namespace quoin::sensor_bridge {

/// Lines of a text file, plain or gzip compressed, one after the other; never the whole file in
/// memory.
class LineReader {
 public:
  /// A longer line is an error: no scan is that long, and a file without line ends must not fill
  /// the memory.
  static constexpr std::size_t max_line_length = 16U << 20U;  // [byte]

  /// Throws ScanFileError when the file cannot be opened.
  explicit LineReader(const std::filesystem::path& file);

  /// The next line, without its end (LF, CR LF or LF CR), valid until the next call; false at the
  /// end of the file. A last line without an end counts, unless the file is compressed and cut off.
  /// Throws ScanFileError.
  bool next(std::string_view& line);

  /// Number of the line last read, from 1; 0 before the first.
  [[nodiscard]] std::size_t line_number() const { return line_number_; }

  /// How much of the file is read, 0 to 1.
  [[nodiscard]] double progress() const;

  /// Throws ScanFileError for the byte at `offset` of the line last read.
  [[noreturn]] void fail(std::size_t offset, const std::string& what) const;

 private:
  struct Closer {
    void operator()(void* handle) const;
  };

  bool fill();

  std::string file_;
  std::unique_ptr<void, Closer> handle_;  // gzFile; zlib stays out of the header
  std::uintmax_t size_ = 0;               // [byte] of the file
  std::vector<char> chunk_;
  std::size_t begin_ = 0;  // unread part of the chunk
  std::size_t end_ = 0;
  std::string line_;  // a line that spans chunks
  std::size_t line_number_ = 0;
};

}  // namespace quoin::sensor_bridge
