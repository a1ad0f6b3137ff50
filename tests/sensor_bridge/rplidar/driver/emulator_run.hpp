// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <thread>

#include "sensor_bridge/rplidar/emulator/emulator.hpp"
#include "sensor_bridge/transport/endpoint.hpp"

namespace quoin::sensor_bridge::rplidar {

/// An S1 that spins up and resets quickly, on "pty", "tcp" or "udp".
[[nodiscard]] inline EmulatorSettings quick_emulator(const std::string& connection = "pty") {
  EmulatorSettings settings;
  settings.connection = connection;
  settings.spin_up_time = 0.05;
  settings.reset_time = 0.05;
  settings.range_stddev = 0.0;
  return settings;
}

/// An emulator in a thread of its own.
class EmulatorRun {
 public:
  explicit EmulatorRun(const EmulatorSettings& settings)
      : emulator_(settings), thread_([this] { emulator_.run(); }) {}
  ~EmulatorRun() {
    emulator_.stop();
    thread_.join();
  }

  [[nodiscard]] Endpoint endpoint() const { return parse_endpoint(emulator_.status().endpoint); }
  [[nodiscard]] EmulatorStatus status() const { return emulator_.status(); }
  void apply(const std::string& fault) { emulator_.apply(parse_typed_fault(fault)); }
  void clear_faults() { emulator_.clear_faults(); }

  /// The motor's speed [rev/s] once it has had time to stop.
  [[nodiscard]] double speed_at_rest() const {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (emulator_.status().motor_speed > 0.0 && std::chrono::steady_clock::now() < limit) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return emulator_.status().motor_speed;
  }

 private:
  Emulator emulator_;
  std::thread thread_;
};

}  // namespace quoin::sensor_bridge::rplidar
