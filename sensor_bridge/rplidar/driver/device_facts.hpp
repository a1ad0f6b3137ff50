// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sensor_bridge/rplidar/driver/client.hpp"
#include "sensor_bridge/rplidar/protocol/configuration.hpp"
#include "sensor_bridge/rplidar/protocol/device_info.hpp"

namespace quoin::sensor_bridge::rplidar {

/// [rev/min] What a device says of its motor.
struct SpeedRange {
  std::uint16_t smallest = 0;
  std::uint16_t usual = 0;
  std::uint16_t largest = 0;

  friend bool operator==(const SpeedRange&, const SpeedRange&) = default;
};

/// All that a device says of itself.
struct DeviceFacts {
  std::string endpoint;
  unsigned baud_rate = 0;  ///< of a serial port
  DeviceInfo info;
  ModelTraits traits;
  DeviceHealth health;
  /// Those of known sample formats. A period or range that cannot be is 0: the period is measured
  /// then.
  std::vector<ScanMode> modes;
  std::uint16_t typical_mode = 0;  ///< id
  std::optional<SpeedRange> speed;
  MotorControl motor = MotorControl::none;
};

/// [bit/s] of the serial line behind the device, which a network kit hides: over TCP and UDP it is
/// the usual one of the model.
[[nodiscard]] inline double line_rate(const DeviceFacts& facts) {
  return facts.baud_rate != 0 ? facts.baud_rate : facts.traits.usual_baud_rate;
}

/// Asks an idle device for everything but its health. Throws as Client does.
[[nodiscard]] DeviceFacts ask_facts(Client& client, const std::string& endpoint, unsigned baud_rate,
                                    const DeviceInfo& info);

/// What to measure with.
struct ScanPlan {
  ScanMode mode;
  std::optional<std::uint16_t> speed;  ///< [rev/min] to be set, where it can be
  std::optional<Diagnosis> warning;    ///< a wish that the device cannot fulfil
};

/// `mode_name` in any case, or empty for the device's own choice; `scan_frequency` [Hz], or 0 for
/// the device's own, which it keeps where no speed can be set. Throws SettingsError when it has no
/// such mode or speed, DeviceError when what it says of the mode cannot be.
[[nodiscard]] ScanPlan plan_scan(const DeviceFacts& facts, const std::string& mode_name,
                                 double scan_frequency);

}  // namespace quoin::sensor_bridge::rplidar
