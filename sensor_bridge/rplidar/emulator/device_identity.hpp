// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sensor_bridge/rplidar/emulator/emulator_settings.hpp"
#include "sensor_bridge/rplidar/protocol/configuration.hpp"
#include "sensor_bridge/rplidar/protocol/device_info.hpp"
#include "sensor_bridge/rplidar/protocol/request.hpp"

namespace quoin::sensor_bridge::rplidar {

/// What the device knows of itself.
struct DeviceIdentity {
  DeviceInfo info;
  std::vector<ScanMode> modes;  ///< a mode's id is its index
  std::uint16_t typical_mode = 1;
  MotorControl motor = MotorControl::speed;
  std::uint16_t usual_speed = 600;  ///< [rev/min]
  std::uint16_t slowest_speed = slowest_motor;
  std::uint16_t fastest_speed = fastest_motor;
  std::uint32_t baud_rate = 256000;
  std::array<std::uint8_t, 12> network_address{};  ///< as the client set it

  /// Its firmware is that one or a later one.
  [[nodiscard]] bool knows_since(unsigned major, unsigned minor) const {
    return info.firmware_major * 256U + info.firmware_minor >= major * 256U + minor;
  }
};

/// Throws std::invalid_argument for a model that is not emulated, and for a serial number or
/// firmware that is none.
[[nodiscard]] DeviceIdentity identity_of(const EmulatorSettings& settings);

/// "A1, A2, ...".
[[nodiscard]] std::string model_names();

/// The payload of the answer to get_configuration, or nothing when the device does not answer this.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> configuration_answer(
    const DeviceIdentity& identity, std::span<const std::uint8_t> request);

/// Carries out set_configuration; the payload of the answer, or nothing as above.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> set_configuration_answer(
    DeviceIdentity& identity, std::span<const std::uint8_t> request);

}  // namespace quoin::sensor_bridge::rplidar
