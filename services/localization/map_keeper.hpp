// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <string>

#include "services/maps/map_file.hpp"

namespace quoin {

/// Keeps a map in a file, written beside the thread that makes it. Only one process writes a file:
/// the first that saves, as long as it lives. Nothing is overwritten that could not be read.
class MapKeeper {
 public:
  static constexpr std::chrono::seconds period{10};

  explicit MapKeeper(std::filesystem::path file) : file_(std::move(file)) {}
  ~MapKeeper();
  MapKeeper(const MapKeeper&) = delete;
  MapKeeper& operator=(const MapKeeper&) = delete;

  /// Whether it is time to save again, and nothing is being written.
  [[nodiscard]] bool due() const;
  /// Begins to write. What goes wrong is in `status` later.
  void save(maps::SavedMap map);
  /// Until what was begun is written.
  void wait();
  /// For the heartbeat: "hall.qmap: saved", or why it is not.
  [[nodiscard]] std::string status();

 private:
  bool lock();
  [[nodiscard]] bool is_written() const;

  std::filesystem::path file_;
  int lock_ = -1;  // descriptor
  std::future<std::string> writing_;
  std::string problem_;
  bool saved_ = false;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

}  // namespace quoin
