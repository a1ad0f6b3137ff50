// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/device_identity.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "sensor_bridge/excerpt.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

// Keys that a driver has no use for.
constexpr std::uint32_t angle_range = 0x00;
constexpr std::uint32_t scan_commands = 0x02;
constexpr std::uint32_t largest_distance = 0x60;
constexpr std::uint32_t model_revision = 0x80;
constexpr std::uint32_t detected_baud_rate = 0xA1;
constexpr std::uint32_t network_address = 0x1CCC0;

// Results of set_configuration.
constexpr std::uint32_t accepted = 0;
constexpr std::uint32_t invalid_data = 0x80008000;
constexpr std::uint32_t unsupported = 0x80008004;

using Bytes = std::vector<std::uint8_t>;

template <class T>
void append(Bytes& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes.push_back(static_cast<std::uint8_t>(value >> (8U * i)));
  }
}

template <class T>
Bytes little_endian(T value) {
  Bytes bytes;
  append(bytes, value);
  return bytes;
}

Bytes text(const std::string& value) {
  Bytes bytes(value.begin(), value.end());
  bytes.push_back(0);
  return bytes;
}

std::uint32_t q8(double value) { return static_cast<std::uint32_t>(std::llround(value * 256.0)); }

std::array<std::uint8_t, 16> parse_serial_number(const std::string& digits) {
  std::array<std::uint8_t, 16> bytes{};
  if (digits.size() != 2 * bytes.size() ||
      digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) {
    throw std::invalid_argument("serial number " + excerpt(digits) +
                                " is none; write 32 hexadecimal digits");
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::uint8_t>(std::stoul(digits.substr(2 * i, 2), nullptr, 16));
  }
  return bytes;
}

std::optional<Bytes> mode_value(const ScanMode& mode, ConfigurationKey key) {
  switch (key) {
    case ConfigurationKey::mode_sample_time:
      return little_endian(q8(mode.sample_period * 1e6));
    case ConfigurationKey::mode_range:
      return little_endian(q8(mode.range_max));
    case ConfigurationKey::mode_format:
      return little_endian(static_cast<std::uint8_t>(mode.format));
    case ConfigurationKey::mode_name:
      return text(mode.name);
    default:
      return std::nullopt;
  }
}

std::optional<Bytes> value_of(const DeviceIdentity& identity, std::uint32_t key,
                              std::span<const std::uint8_t> extra) {
  switch (key) {
    case static_cast<std::uint32_t>(ConfigurationKey::desired_speed): {
      Bytes bytes = little_endian(identity.usual_speed);
      append(bytes, std::uint16_t{0});  // an S1 knows no PWM
      return bytes;
    }
    case static_cast<std::uint32_t>(ConfigurationKey::smallest_speed):
      return little_endian(slowest_motor);
    case static_cast<std::uint32_t>(ConfigurationKey::largest_speed):
      return little_endian(fastest_motor);
    case static_cast<std::uint32_t>(ConfigurationKey::mode_count):
      return little_endian(static_cast<std::uint16_t>(identity.modes.size()));
    case static_cast<std::uint32_t>(ConfigurationKey::typical_mode):
      return little_endian(identity.typical_mode);
    case static_cast<std::uint32_t>(ConfigurationKey::model_name):
      return text(model_text(identity.info));
    case largest_distance:
      return little_endian(q8(identity.modes.front().range_max));
    case detected_baud_rate:
      return little_endian(identity.baud_rate);
    case network_address:
      return Bytes(identity.network_address.begin(), identity.network_address.end());
    // Without Ethernet there is no address, but an answer spares the client a wait.
    case static_cast<std::uint32_t>(ConfigurationKey::address):
    case angle_range:
    case scan_commands:
    case model_revision:
      return Bytes{};
    default:
      break;
  }
  if (extra.size() < 2) return std::nullopt;
  const std::size_t id = extra[0] | extra[1] << 8U;
  if (id >= identity.modes.size()) return std::nullopt;
  return mode_value(identity.modes[id], static_cast<ConfigurationKey>(key));
}

std::optional<std::uint32_t> key_of(std::span<const std::uint8_t> request) {
  if (request.size() < 4) return std::nullopt;
  return parse_number(request.first(4));
}

std::string command_name(Command command) {
  switch (command) {
    case Command::scan:
      return "scan";
    case Command::force_scan:
      return "force_scan";
    case Command::stop:
      return "stop";
    case Command::reset:
      return "reset";
    case Command::info:
      return "info";
    case Command::health:
      return "health";
    case Command::sample_rate:
      return "sample_rate";
    case Command::express_scan:
      return "express_scan";
    case Command::hq_scan:
      return "hq_scan";
    case Command::get_configuration:
      return "get_configuration";
    case Command::set_configuration:
      return "set_configuration";
    case Command::confirm_baud_rate:
      return "confirm_baud_rate";
    case Command::motor_speed:
      return "motor_speed";
    case Command::motor_pwm:
      return "motor_pwm";
    case Command::accessory_board:
      return "accessory_board";
  }
  char unknown[32];
  std::snprintf(unknown, sizeof unknown, "unknown command 0x%02X", static_cast<unsigned>(command));
  return unknown;
}

}  // namespace

DeviceIdentity s1_identity(const EmulatorSettings& settings) {
  DeviceIdentity identity;
  identity.info = {0x61, 1, 28, 18, parse_serial_number(settings.serial_number)};
  identity.usual_speed = static_cast<std::uint16_t>(std::lround(settings.frequency * 60.0));
  identity.baud_rate = static_cast<std::uint32_t>(settings.baud_rate);
  identity.modes = {{0, "Standard", 244e-6, 40.0, SampleFormat::standard},
                    {1, "DenseBoost", 108e-6, 40.0, SampleFormat::dense}};
  if (settings.all_formats) {
    // As many samples as 256000 bit/s can carry.
    identity.modes.push_back({2, "Express", 125e-6, 40.0, SampleFormat::express});
    identity.modes.push_back({3, "HQ", 500e-6, 40.0, SampleFormat::hq});
    identity.modes.push_back({4, "Boost", 62.5e-6, 40.0, SampleFormat::ultra});
    identity.modes.push_back({5, "UltraDense", 125e-6, 40.0, SampleFormat::ultra_dense});
  }
  return identity;
}

std::optional<Bytes> configuration_answer(const DeviceIdentity& identity,
                                          std::span<const std::uint8_t> request) {
  const std::optional<std::uint32_t> key = key_of(request);
  if (!key) return std::nullopt;
  const std::optional<Bytes> value = value_of(identity, *key, request.subspan(4));
  if (!value) return std::nullopt;
  return encode_configuration(static_cast<ConfigurationKey>(*key), *value);
}

std::optional<Bytes> set_configuration_answer(DeviceIdentity& identity,
                                              std::span<const std::uint8_t> request) {
  const std::optional<std::uint32_t> key = key_of(request);
  if (!key) return std::nullopt;
  const std::span<const std::uint8_t> value = request.subspan(4);
  std::uint32_t result = unsupported;
  if (*key == network_address) {
    result = value.size() == identity.network_address.size() ? accepted : invalid_data;
    if (result == accepted) {
      std::copy(value.begin(), value.end(), identity.network_address.begin());
    }
  }
  return encode_configuration(static_cast<ConfigurationKey>(*key), little_endian(result));
}

std::string request_text(const Request& request) {
  std::string result = command_name(request.command());
  const std::span<const std::uint8_t> payload = request.payload();
  char detail[48] = "";
  if (request.command() == Command::express_scan && !payload.empty()) {
    std::snprintf(detail, sizeof detail, " in mode %u", unsigned{payload[0]});
  } else if (request.command() == Command::motor_speed && payload.size() == 2) {
    std::snprintf(detail, sizeof detail, " %u rev/min", payload[0] | payload[1] << 8U);
  } else if (request.command() == Command::get_configuration ||
             request.command() == Command::set_configuration) {
    if (const std::optional<std::uint32_t> key = key_of(payload)) {
      std::snprintf(detail, sizeof detail, " 0x%02X", *key);
      if (payload.size() == 6) {
        std::snprintf(detail, sizeof detail, " 0x%02X of mode %u", *key,
                      payload[4] | payload[5] << 8U);
      }
    }
  }
  return result + detail;
}

}  // namespace quoin::sensor_bridge::rplidar
