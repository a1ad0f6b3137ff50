// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace quoin {

/// A file that is open for reading, or why it is not.
struct RegularFile {
  int descriptor = -1;     ///< to be closed by the caller; -1 where there is a problem
  std::uint64_t size = 0;  ///< [byte]
  std::string problem;     ///< such as "it is a folder"
};

/// All input files are opened here: a FIFO, a socket or a device would have the reader wait, for
/// good perhaps, and gives no end. Does not block; nor do reads of the descriptor.
[[nodiscard]] RegularFile open_regular(const std::filesystem::path& file);

/// Reads a regular file of at most `longest` bytes into `text`, whatever size it says it has.
/// Returns what is wrong, or an empty text.
[[nodiscard]] std::string read_regular(const std::filesystem::path& file, std::size_t longest,
                                       std::string& text);

}  // namespace quoin
