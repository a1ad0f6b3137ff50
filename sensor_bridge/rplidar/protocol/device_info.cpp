// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/device_info.hpp"

#include <algorithm>
#include <cstdio>

#include "sensor_bridge/rplidar/protocol/little_endian.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

/// The high four bits of a model number count through all series.
struct Series {
  char letter;
  unsigned first;  ///< number of its first product
};

constexpr Series series[] = {{'M', 12}, {'T', 9}, {'S', 6}, {'C', 4}, {'A', 1}};

unsigned major_number(const DeviceInfo& info) { return info.model >> 4; }

}  // namespace

std::optional<DeviceInfo> parse_info(std::span<const std::uint8_t> payload) {
  if (payload.size() < DeviceInfo::bytes) return std::nullopt;
  DeviceInfo info{payload[0], payload[2], payload[1], payload[3], {}};
  std::ranges::copy(payload.subspan(4, info.serial_number.size()), info.serial_number.begin());
  return info;
}

std::optional<DeviceHealth> parse_health(std::span<const std::uint8_t> payload) {
  if (payload.size() < DeviceHealth::bytes) return std::nullopt;
  const bool known = payload[0] <= static_cast<std::uint8_t>(Health::error);
  return DeviceHealth{known ? static_cast<Health>(payload[0]) : Health::warning,
                      load<std::uint16_t>(payload.data() + 1), payload[0]};
}

std::optional<SampleTimes> parse_sample_times(std::span<const std::uint8_t> payload) {
  if (payload.size() < SampleTimes::bytes) return std::nullopt;
  return SampleTimes{load<std::uint16_t>(payload.data()), load<std::uint16_t>(payload.data() + 2)};
}

std::array<std::uint8_t, DeviceInfo::bytes> encode(const DeviceInfo& info) {
  std::array<std::uint8_t, DeviceInfo::bytes> bytes{info.model, info.firmware_minor,
                                                    info.firmware_major, info.hardware};
  std::ranges::copy(info.serial_number, bytes.begin() + 4);
  return bytes;
}

std::array<std::uint8_t, DeviceHealth::bytes> encode(const DeviceHealth& health) {
  std::array<std::uint8_t, DeviceHealth::bytes> bytes{health.reported};
  store(bytes.data() + 1, health.error_code);
  return bytes;
}

std::array<std::uint8_t, SampleTimes::bytes> encode(const SampleTimes& times) {
  std::array<std::uint8_t, SampleTimes::bytes> bytes{};
  store(bytes.data(), times.standard_us);
  store(bytes.data() + 2, times.express_us);
  return bytes;
}

std::string firmware_text(const DeviceInfo& info) {
  char text[8];
  std::snprintf(text, sizeof(text), "%u.%02u", unsigned{info.firmware_major},
                unsigned{info.firmware_minor});
  return text;
}

std::string serial_number_text(const DeviceInfo& info) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string text;
  for (const std::uint8_t byte : info.serial_number) {
    text += digits[byte >> 4];
    text += digits[byte & 0xF];
  }
  return text;
}

std::string model_text(const DeviceInfo& info) {
  char text[16];
  for (const Series& candidate : series) {
    if (major_number(info) < candidate.first) continue;
    std::snprintf(text, sizeof(text), "%c%uM%u", candidate.letter,
                  major_number(info) - candidate.first + 1, info.model & 0xFu);
    return text;
  }
  std::snprintf(text, sizeof(text), "unknown (0x%02X)", unsigned{info.model});
  return text;
}

ModelTraits traits_of(const DeviceInfo& info) {
  const unsigned number = major_number(info);
  const bool triangulates = number < 4;
  ModelTraits traits;
  traits.known = number > 0;
  // Triangulating devices learned it with firmware 1.24; those that time light always had it.
  traits.has_configuration =
      !triangulates || info.firmware_major * 256 + info.firmware_minor >= 256 + 24;
  traits.has_motor_speed = number >= 6;
  traits.may_have_board = number == 2 || number == 3;
  if (traits.has_motor_speed) traits.motor = MotorControl::speed;
  if (triangulates) traits.motor = MotorControl::line;
  if (triangulates) {
    traits.usual_baud_rate = info.hardware < 6 ? 115200 : 256000;
  } else if (number < 6 || info.model == 0x82) {
    traits.usual_baud_rate = 460800;
  } else {
    traits.usual_baud_rate = number == 6 ? 256000 : 1000000;
  }
  return traits;
}

std::string health_text(const DeviceHealth& health) {
  return "status " + std::to_string(health.reported) + ", error code " +
         std::to_string(health.error_code);
}

std::string_view name_of(Health health) {
  switch (health) {
    case Health::good:
      return "good";
    case Health::warning:
      return "warning";
    case Health::error:
      return "protection stop";
  }
  return "unknown";
}

}  // namespace quoin::sensor_bridge::rplidar
