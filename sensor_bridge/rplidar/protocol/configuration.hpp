// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sensor_bridge/rplidar/protocol/sample_format.hpp"

namespace quoin::sensor_bridge::rplidar {

/// What a device can be asked about itself with Command::get_configuration.
enum class ConfigurationKey : std::uint32_t {
  desired_speed = 0x01,     ///< u16 [rev/min], u16 reference PWM
  smallest_speed = 0x04,    ///< u16 [rev/min]
  largest_speed = 0x05,     ///< u16 [rev/min]
  mode_count = 0x70,        ///< u16
  mode_sample_time = 0x71,  ///< of a mode: u32 [1/256 us]
  mode_range = 0x74,        ///< of a mode: u32 [1/256 m]
  mode_format = 0x75,       ///< of a mode: u8, a SampleFormat
  address = 0x79,           ///< 6 bytes, of devices with Ethernet
  typical_mode = 0x7C,      ///< u16
  mode_name = 0x7F,         ///< of a mode: text that ends with 0
  model_name = 0x81,        ///< text that ends with 0
};

/// One way in which a device can measure.
struct ScanMode {
  std::uint16_t id = 0;
  std::string name;
  double sample_period = 0.0;  ///< [s]
  double range_max = 0.0;      ///< [m]
  SampleFormat format = SampleFormat::standard;
};

/// The payload of an answer to get_configuration without the key that it begins with, or nothing
/// when it answers another question or is too short.
[[nodiscard]] std::optional<std::span<const std::uint8_t>> configuration_value(
    ConfigurationKey key, std::span<const std::uint8_t> payload);

/// Little-endian number of exactly 1, 2 or 4 bytes.
[[nodiscard]] std::optional<std::uint32_t> parse_number(std::span<const std::uint8_t> value);
/// [s] from the 4 bytes of mode_sample_time; nothing when no device can mean it (0, or over 0.1 s).
[[nodiscard]] std::optional<double> parse_sample_time(std::span<const std::uint8_t> value);
/// Printable text up to the first 0; other bytes become '?'.
[[nodiscard]] std::string parse_text(std::span<const std::uint8_t> value);

/// The other end: the payload of an answer, key included.
[[nodiscard]] std::vector<std::uint8_t> encode_configuration(ConfigurationKey key,
                                                             std::span<const std::uint8_t> value);

}  // namespace quoin::sensor_bridge::rplidar
