// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "deploy/diagnostics/check.hpp"

namespace quoin::deploy {

/// A shared-memory file of Fast DDS that no process has open, mapped or locked.
struct StaleFile {
  std::filesystem::path path;
  std::uint64_t bytes = 0;
  bool ours = false;  ///< this user may remove it
};

/// What killed Fast DDS programs left in `folder` (/dev/shm), as far as `processes` (/proc) shows.
/// Files of other users are left out unless this is root, who alone sees what all processes use.
[[nodiscard]] std::vector<StaleFile> stale_files(const std::filesystem::path& folder,
                                                 const std::filesystem::path& processes);

/// Removes those of this user; returns how many.
std::size_t remove(const std::vector<StaleFile>& files);

[[nodiscard]] Check check_shared_memory(const std::vector<StaleFile>& files);

}  // namespace quoin::deploy
