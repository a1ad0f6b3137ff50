// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>

namespace quoin::sensor_bridge::rplidar {

/// Waits until the time has come: true, or false at once when the program is to stop.
using Interruption = std::function<bool(std::chrono::steady_clock::time_point)>;

/// Thrown out of whatever was going on when the program is to stop. Not an error.
struct Stopped {};

/// Waits until the time has come, or throws Stopped.
inline void wait_until(const Interruption& interruption,
                       std::chrono::steady_clock::time_point time) {
  if (!interruption(time)) throw Stopped{};
}

}  // namespace quoin::sensor_bridge::rplidar
