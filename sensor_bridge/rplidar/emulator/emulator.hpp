// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <poll.h>
#include <string>
#include <vector>

#include "sensor_bridge/rplidar/emulator/emulated_device.hpp"
#include "sensor_bridge/rplidar/emulator/emulator_settings.hpp"
#include "sensor_bridge/rplidar/emulator/link.hpp"
#include "sensor_bridge/transport/file_descriptor.hpp"

namespace quoin::sensor_bridge::rplidar {

/// How an emulator is doing.
struct EmulatorStatus {
  double time = 0.0;  ///< [s] since it was made
  DeviceState state = DeviceState::idle;
  double motor_speed = 0.0;  ///< [rev/s]
  std::string endpoint;
  std::optional<unsigned> client_baud_rate;  ///< [bit/s] where clients can set one
  DeviceCounts counts;
  std::uint64_t sent_bytes = 0;     ///< that the client was given
  std::uint64_t misread_bytes = 0;  ///< in either direction, for the baud rates differ
  std::uint64_t lost_bytes = 0;     ///< that were not read, or for which the line was too slow
};

/// On one line.
[[nodiscard]] std::string status_text(const EmulatorStatus& status);

/// An emulated device with its link, in real time. All but `run` may be called by any thread.
class Emulator {
 public:
  /// Called for each event, with the time [s] since the start; must not call the
  /// emulator.
  using Report = std::function<void(double, const std::string&)>;

  /// Makes the endpoint. World files are relative to `base_directory`. Throws std::exception when
  /// the settings cannot be or the endpoint cannot be had.
  explicit Emulator(const EmulatorSettings& settings, Report report = {},
                    const std::filesystem::path& base_directory = {});

  /// Serves clients until `stop`.
  void run();
  void stop();

  /// The fault's times count from now.
  void apply(const Fault& fault);
  /// Ends all faults, also those to come.
  void clear_faults();

  [[nodiscard]] EmulatorStatus status() const;

 private:
  using TimePoint = std::chrono::steady_clock::time_point;

  void step(TimePoint now);
  void plug(TimePoint now);
  void misread(std::vector<std::uint8_t>& bytes, bool from_client, TimePoint now);
  [[nodiscard]] TimePoint next_step(TimePoint now) const;
  void wake() const;
  void report(TimePoint now, const std::string& what) const;

  const TimePoint start_;
  Report report_;
  mutable std::mutex mutex_;  // of all but the wake-up
  std::unique_ptr<Link> link_;
  EmulatedDevice device_;
  unsigned baud_rate_;
  std::vector<std::uint8_t> bytes_;
  std::uint64_t misread_bytes_ = 0;
  unsigned misread_baud_rate_ = 0;  // that was reported last
  TimePoint retry_plug_in_{};
  FileDescriptor wake_up_;
  std::atomic<bool> stop_ = false;
};

}  // namespace quoin::sensor_bridge::rplidar
