// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <tuple>

namespace quoin::deploy {

/// Notices that a file has been changed or replaced by another of its name, as editors do, and is
/// at rest again. It looks at the file rather than being notified, which works on every file
/// system.
class FileWatch {
 public:
  using Clock = std::chrono::steady_clock;

  explicit FileWatch(std::filesystem::path file) : file_(std::move(file)), known_(look()) {}

  /// True once for each change, when the file has looked the same for a while. A file that is away
  /// is no change. Looks no more often than needed.
  [[nodiscard]] bool changed(Clock::time_point now = Clock::now());

 private:
  // Device, inode, size, time of the last change of content [ns].
  using Identity = std::tuple<std::uint64_t, std::uint64_t, std::int64_t, std::int64_t>;
  [[nodiscard]] std::optional<Identity> look() const;

  std::filesystem::path file_;
  std::optional<Identity> known_;
  std::optional<Identity> seen_;
  Clock::time_point seen_since_{};
  Clock::time_point next_look_{};
};

}  // namespace quoin::deploy
