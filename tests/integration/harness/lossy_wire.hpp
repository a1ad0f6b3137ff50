// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <deque>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "sensor_bridge/transport/file_descriptor.hpp"

namespace quoin::tests {

/// An Ethernet interface of this name where the thread stands; what it sends is read from the
/// descriptor, what is written there it receives. Throws std::system_error.
[[nodiscard]] sensor_bridge::FileDescriptor make_tap(const std::string& name);

/// A link between two of them that loses and delays frames, for kernels that cannot.
class LossyWire {
 public:
  LossyWire(sensor_bridge::FileDescriptor one, sensor_bridge::FileDescriptor other);
  ~LossyWire();
  LossyWire(const LossyWire&) = delete;
  LossyWire& operator=(const LossyWire&) = delete;

  void impair(double loss, std::chrono::milliseconds delay);

 private:
  using Clock = std::chrono::steady_clock;
  struct Frame {
    Clock::time_point due;
    std::vector<char> bytes;
  };
  struct Direction {
    int from;
    int to;
    std::deque<Frame> frames;
  };

  void run();
  void take(Direction& direction);
  /// Sends what is due.
  void give(Direction& direction, Clock::time_point now);

  sensor_bridge::FileDescriptor one_;
  sensor_bridge::FileDescriptor other_;
  sensor_bridge::FileDescriptor end_;
  std::mutex mutex_;
  double loss_ = 0.0;
  std::chrono::milliseconds delay_{0};
  std::mt19937 random_{77};
  std::thread thread_;
};

}  // namespace quoin::tests
