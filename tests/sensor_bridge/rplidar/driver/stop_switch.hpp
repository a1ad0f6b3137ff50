// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "sensor_bridge/rplidar/driver/interruption.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Ends what waits with its interruption.
class StopSwitch {
 public:
  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
  }

  [[nodiscard]] Interruption interruption() {
    return [this](std::chrono::steady_clock::time_point time) {
      std::unique_lock lock(mutex_);
      return !changed_.wait_until(lock, time, [this] { return stopped_; });
    };
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopped_ = false;
};

/// Never stops.
[[nodiscard]] inline Interruption uninterrupted() {
  return [](std::chrono::steady_clock::time_point time) {
    std::this_thread::sleep_until(time);
    return true;
  };
}

}  // namespace quoin::sensor_bridge::rplidar
