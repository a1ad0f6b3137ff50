// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/device_identity.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "core/parameters/parameter.hpp"
#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"

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

struct ModelMode {
  std::string_view name;
  double microseconds = 0.0;
  double range = 0.0;  // [m]
  SampleFormat format = SampleFormat::standard;
};

struct Model {
  std::string_view name;
  std::uint8_t number;
  std::uint8_t firmware_major;
  std::uint8_t firmware_minor;
  std::uint8_t hardware;
  std::uint32_t baud_rate;
  MotorControl motor;
  std::uint16_t slowest;  // [rev/min]
  std::uint16_t fastest;
  std::uint16_t typical_mode;
  std::array<ModelMode, 5> modes;
};

// Modes and periods as users have posted them from their devices; those of S2 and S3 in ultra-dense
// capsules are taken from the vendor's data sheets and its software, not from a device.
constexpr Model models[] = {
    {"A1",
     0x18,
     1,
     29,
     7,
     115200,
     MotorControl::line,
     300,
     600,
     3,
     {{{"Standard", 508.0, 12.0, SampleFormat::standard},
       {"Express", 254.0, 12.0, SampleFormat::express},
       {"Boost", 127.0, 12.0, SampleFormat::ultra},
       {"Sensitivity", 127.0, 12.0, SampleFormat::ultra},
       {"Stability", 203.0, 12.0, SampleFormat::express}}}},
    {"A2",
     0x28,
     1,
     29,
     5,
     115200,
     MotorControl::pwm,
     300,
     900,
     2,
     {{{"Standard", 500.0, 12.0, SampleFormat::standard},
       {"Express", 250.0, 12.0, SampleFormat::express},
       {"Boost", 125.0, 12.0, SampleFormat::ultra}}}},
    {"A3",
     0x31,
     1,
     29,
     6,
     256000,
     MotorControl::pwm,
     300,
     1200,
     3,
     {{{"Standard", 252.0, 25.0, SampleFormat::standard},
       {"Express", 126.0, 25.0, SampleFormat::express},
       {"Boost", 62.5, 25.0, SampleFormat::ultra},
       {"Sensitivity", 62.5, 25.0, SampleFormat::ultra},
       {"Stability", 100.0, 15.0, SampleFormat::ultra}}}},
    {"C1",
     0x41,
     1,
     1,
     18,
     460800,
     MotorControl::none,
     600,
     600,
     1,
     {{{"Standard", 200.0, 16.0, SampleFormat::standard},
       {"DenseBoost", 200.0, 16.0, SampleFormat::dense}}}},
    {"S1",
     0x61,
     1,
     28,
     18,
     256000,
     MotorControl::speed,
     480,
     900,
     1,
     {{{"Standard", 244.0, 40.0, SampleFormat::standard},
       {"DenseBoost", 108.0, 40.0, SampleFormat::dense}}}},
    {"S2",
     0x71,
     1,
     1,
     18,
     1000000,
     MotorControl::speed,
     480,
     900,
     1,
     {{{"Standard", 62.5, 16.0, SampleFormat::standard},
       {"DenseBoost", 31.25, 30.0, SampleFormat::dense}}}},
    {"S3",
     0x81,
     1,
     1,
     18,
     1000000,
     MotorControl::speed,
     480,
     1200,
     1,
     {{{"Standard", 62.5, 16.0, SampleFormat::standard},
       {"UltraDense", 31.25, 40.0, SampleFormat::ultra_dense}}}},
};

std::pair<std::uint8_t, std::uint8_t> parse_firmware(const std::string& text, const Model& model) {
  if (text.empty()) return {model.firmware_major, model.firmware_minor};
  const std::size_t point = text.find('.');
  const auto major =
      sensor_bridge::parse_number<std::uint8_t>(std::string_view(text).substr(0, point));
  const auto minor =
      point == std::string::npos
          ? std::nullopt
          : sensor_bridge::parse_number<std::uint8_t>(std::string_view(text).substr(point + 1));
  if (!major || !minor) {
    throw std::invalid_argument("firmware " + excerpt(text) + " is none; write it like 1.15");
  }
  return {*major, *minor};
}

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
      return little_endian(identity.slowest_speed);
    case static_cast<std::uint32_t>(ConfigurationKey::largest_speed):
      return little_endian(identity.fastest_speed);
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

}  // namespace

DeviceIdentity identity_of(const EmulatorSettings& settings) {
  const auto model = std::ranges::find(models, settings.model, &Model::name);
  if (model == std::end(models)) {
    std::vector<std::string> names;
    for (const Model& known : models) names.emplace_back(known.name);
    throw std::invalid_argument("there is no emulated model " + excerpt(settings.model) +
                                suggestion(settings.model, names) + "; models: " + model_names());
  }
  DeviceIdentity identity;
  const auto [major, minor] = parse_firmware(settings.firmware, *model);
  identity.info = {model->number, major, minor, model->hardware,
                   parse_serial_number(settings.serial_number)};
  identity.motor = model->motor;
  identity.slowest_speed = model->slowest;
  identity.fastest_speed = model->fastest;
  identity.usual_speed = static_cast<std::uint16_t>(std::lround(
      std::clamp(settings.frequency * 60.0, double(model->slowest), double(model->fastest))));
  identity.baud_rate =
      settings.baud_rate == 0 ? model->baud_rate : static_cast<std::uint32_t>(settings.baud_rate);
  for (const ModelMode& mode : model->modes) {
    if (mode.name.empty()) break;
    identity.modes.push_back({static_cast<std::uint16_t>(identity.modes.size()),
                              std::string(mode.name), mode.microseconds * 1e-6, mode.range,
                              mode.format});
  }
  identity.typical_mode = model->typical_mode;
  if (settings.all_formats) {
    if (settings.model != "S1") throw std::invalid_argument("all_formats is of an S1");
    // As many samples as 256000 bit/s can carry.
    identity.modes.push_back({2, "Express", 125e-6, 40.0, SampleFormat::express});
    identity.modes.push_back({3, "HQ", 500e-6, 40.0, SampleFormat::hq});
    identity.modes.push_back({4, "Boost", 62.5e-6, 40.0, SampleFormat::ultra});
    identity.modes.push_back({5, "UltraDense", 125e-6, 40.0, SampleFormat::ultra_dense});
  }
  return identity;
}

std::string model_names() {
  std::string names;
  for (const Model& model : models) names += (names.empty() ? "" : ", ") + std::string(model.name);
  return names;
}

std::optional<Bytes> configuration_answer(const DeviceIdentity& identity,
                                          std::span<const std::uint8_t> request) {
  const std::optional<std::uint32_t> key = key_of(request);
  if (!key) return std::nullopt;
  std::optional<Bytes> value = value_of(identity, *key, request.subspan(4));
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

}  // namespace quoin::sensor_bridge::rplidar
