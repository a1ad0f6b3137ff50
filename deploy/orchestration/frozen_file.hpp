// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace quoin::deploy {

/// Text that the processes we start read as a file, whatever happens to the file it came from. It
/// is in memory, cannot be changed, and is gone with this process.
class FrozenFile {
 public:
  /// Throws std::system_error.
  explicit FrozenFile(const std::string& text);
  ~FrozenFile();
  FrozenFile(const FrozenFile&) = delete;
  FrozenFile& operator=(const FrozenFile&) = delete;

  /// Where other processes of the same user find it.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  int descriptor_ = -1;
  std::filesystem::path path_;
};

}  // namespace quoin::deploy
