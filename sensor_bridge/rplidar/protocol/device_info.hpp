// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace quoin::sensor_bridge::rplidar {

/// Answer to Command::info.
struct DeviceInfo {
  static constexpr std::size_t bytes = 20;

  std::uint8_t model = 0;
  std::uint8_t firmware_major = 0;
  std::uint8_t firmware_minor = 0;
  std::uint8_t hardware = 0;
  std::array<std::uint8_t, 16> serial_number{};

  friend bool operator==(const DeviceInfo&, const DeviceInfo&) = default;
};

enum class Health : std::uint8_t { good = 0, warning = 1, error = 2 };

/// "good", "warning", "protection stop".
[[nodiscard]] std::string_view name_of(Health health);

/// Answer to Command::health.
struct DeviceHealth {
  static constexpr std::size_t bytes = 3;

  Health status = Health::good;
  std::uint16_t error_code = 0;
  /// As the device says it. What is none of Health, as some S2 send it, counts as a warning.
  std::uint8_t reported = static_cast<std::uint8_t>(status);

  friend bool operator==(const DeviceHealth&, const DeviceHealth&) = default;
};

/// "status 1, error code 16".
[[nodiscard]] std::string health_text(const DeviceHealth& health);

/// Answer to Command::sample_rate.
struct SampleTimes {
  static constexpr std::size_t bytes = 4;

  std::uint16_t standard_us = 0;
  std::uint16_t express_us = 0;

  friend bool operator==(const SampleTimes&, const SampleTimes&) = default;
};

/// Nothing when the payload is too short. What newer devices append is left alone.
[[nodiscard]] std::optional<DeviceInfo> parse_info(std::span<const std::uint8_t> payload);
[[nodiscard]] std::optional<DeviceHealth> parse_health(std::span<const std::uint8_t> payload);
[[nodiscard]] std::optional<SampleTimes> parse_sample_times(std::span<const std::uint8_t> payload);

[[nodiscard]] std::array<std::uint8_t, DeviceInfo::bytes> encode(const DeviceInfo& info);
[[nodiscard]] std::array<std::uint8_t, DeviceHealth::bytes> encode(const DeviceHealth& health);
[[nodiscard]] std::array<std::uint8_t, SampleTimes::bytes> encode(const SampleTimes& times);

/// "1.28".
[[nodiscard]] std::string firmware_text(const DeviceInfo& info);
/// 32 hexadecimal digits, upper case.
[[nodiscard]] std::string serial_number_text(const DeviceInfo& info);
/// "S1M1", or "unknown (0x0F)" for a model of none of the vendor's series.
[[nodiscard]] std::string model_text(const DeviceInfo& info);

/// By what the motor is driven.
enum class MotorControl {
  none,   ///< it turns with each scan
  line,   ///< the "terminal ready" line of the serial port: it stands while that is set
  pwm,    ///< an accessory board with a PWM output: it stands until that is set
  speed,  ///< the device holds the speed that it is told
};

/// What follows from the model number.
struct ModelTraits {
  bool known = false;
  bool has_configuration = false;  ///< answers get_configuration
  bool has_motor_speed = false;    ///< takes motor_speed in revolutions per minute
  MotorControl motor = MotorControl::none;
  bool may_have_board = false;  ///< is to be asked for an accessory board; by its line without one
  unsigned usual_baud_rate = 115200;
};

[[nodiscard]] ModelTraits traits_of(const DeviceInfo& info);

}  // namespace quoin::sensor_bridge::rplidar
