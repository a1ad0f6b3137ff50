// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/device_facts.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/rplidar/driver/reply_reading.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr std::uint32_t most_modes = 32;
constexpr double largest_range = 1000.0;  // [m]
/// What the vendor's software takes where a device does not say.
constexpr std::uint16_t usual_speed = 600;

std::uint32_t ask_number(Client& client, ConfigurationKey key, std::optional<std::uint16_t> mode,
                         const std::string& name) {
  const auto number = parse_number(client.configuration(key, mode));
  if (!number) throw DeviceError(wrong_value(name, "a number of no known size"));
  return *number;
}

std::string ask_name(Client& client, std::uint16_t id) {
  const std::string name = parse_text(client.configuration(ConfigurationKey::mode_name, id));
  return name.empty() ? "mode " + std::to_string(id) : name;
}

void ask_modes(Client& client, DeviceFacts& facts) {
  using Key = ConfigurationKey;
  const std::uint32_t count = ask_number(client, Key::mode_count, {}, facts.endpoint);
  if (count == 0 || count > most_modes) {
    throw DeviceError(wrong_value(facts.endpoint, std::to_string(count) + " scan modes"));
  }
  for (std::uint16_t id = 0; id < count; ++id) {
    const std::vector<std::uint8_t> type = client.configuration(Key::mode_format, id);
    const auto format = type.empty() ? std::nullopt : sample_format(type.front());
    if (!format) continue;
    const double range = ask_number(client, Key::mode_range, id, facts.endpoint) / 256.0;
    const auto period = parse_sample_time(client.configuration(Key::mode_sample_time, id));
    facts.modes.push_back({.id = id,
                           .name = ask_name(client, id),
                           .sample_period = period.value_or(0.0),
                           .range_max = range <= largest_range ? range : 0.0,
                           .format = *format});
  }
  facts.typical_mode =
      static_cast<std::uint16_t>(ask_number(client, Key::typical_mode, {}, facts.endpoint));
}

/// Firmware before 1.17 does not know the question, and no express scans.
SampleTimes old_sample_times(Client& client, const DeviceInfo& info) {
  constexpr SampleTimes usual{.standard_us = 476, .express_us = 0};
  if (info.firmware_major * 256 + info.firmware_minor >= 256 + 17) return client.sample_times();
  try {
    return client.sample_times();
  } catch (const DeviceError&) {
    return usual;
  }
}

bool has_motor_pwm(Client& client) {
  try {
    return client.has_motor_pwm();
  } catch (const DeviceError&) {
    return false;  // no board is there to answer
  }
}

/// Devices without a configuration: two modes, and no word of how far they measure.
void ask_sample_times(Client& client, DeviceFacts& facts) {
  constexpr double range = 12.0;  // [m] of the A1 and A2
  const SampleTimes times = old_sample_times(client, facts.info);
  facts.modes.push_back({.id = 0,
                         .name = "Standard",
                         .sample_period = times.standard_us * 1e-6,
                         .range_max = range,
                         .format = SampleFormat::standard});
  facts.typical_mode = 0;
  if (times.express_us == 0) return;
  facts.modes.push_back({.id = 0,
                         .name = "Express",
                         .sample_period = times.express_us * 1e-6,
                         .range_max = range,
                         .format = SampleFormat::express});
}

std::optional<SpeedRange> ask_speed(Client& client) {
  using Key = ConfigurationKey;
  try {
    SpeedRange speed;
    const auto ask = [&](Key key) {
      std::vector<std::uint8_t> value = client.configuration(key);
      if (value.size() > 2) value.resize(2);  // some say more than the speed
      return static_cast<std::uint16_t>(parse_number(value).value_or(0));
    };
    speed.usual = ask(Key::desired_speed);
    speed.smallest = ask(Key::smallest_speed);
    speed.largest = ask(Key::largest_speed);
    if (speed.usual == 0 || speed.largest < speed.smallest || speed.largest == 0) return {};
    return speed;
  } catch (const DeviceError&) {
    return std::nullopt;  // old firmware does not know the question
  }
}

bool same_name(const std::string& a, const std::string& b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::string names_of(const std::vector<ScanMode>& modes) {
  std::string names;
  for (const ScanMode& mode : modes) names += (names.empty() ? "" : ", ") + mode.name;
  return names.empty() ? "none that can be read" : names;
}

/// Of modes with the same id, as those of devices without a configuration, the later is the faster.
const ScanMode* find_mode(const DeviceFacts& facts, const std::string& name) {
  const ScanMode* found = nullptr;
  for (const ScanMode& mode : facts.modes) {
    if (name.empty() ? mode.id == facts.typical_mode : same_name(mode.name, name)) found = &mode;
  }
  return found;
}

std::string short_number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

std::optional<std::uint16_t> plan_speed(const DeviceFacts& facts, double scan_frequency) {
  const auto refuse = [&](const std::string& reason, const std::string& advice) {
    throw SettingsError({.finding = Finding::speed_out_of_range,
                         .text = facts.endpoint + ": scan frequency " +
                                 short_number(scan_frequency) + " Hz: " + reason,
                         .advice = advice});
  };
  if (!facts.traits.has_motor_speed) return std::nullopt;
  if (scan_frequency == 0.0) return facts.speed ? facts.speed->usual : usual_speed;
  const double speed = std::round(60.0 * scan_frequency);
  const double smallest = facts.speed ? std::max<double>(facts.speed->smallest, 1) : 1;
  const double largest = facts.speed ? facts.speed->largest : 6000;
  if (!(speed >= smallest && speed <= largest)) {
    refuse("out of the device's range",
           "choose within " + short_number(smallest / 60) + ".." + short_number(largest / 60));
  }
  return static_cast<std::uint16_t>(speed);
}

}  // namespace

DeviceFacts ask_facts(Client& client, const std::string& endpoint, unsigned baud_rate,
                      const DeviceInfo& info) {
  DeviceFacts facts;
  facts.endpoint = endpoint;
  facts.baud_rate = baud_rate;
  facts.info = info;
  facts.traits = traits_of(info);
  if (facts.traits.has_configuration) {
    ask_modes(client, facts);
  } else {
    ask_sample_times(client, facts);
  }
  if (facts.traits.has_motor_speed) facts.speed = ask_speed(client);
  facts.motor = facts.traits.motor;
  if (facts.traits.may_have_board && has_motor_pwm(client)) facts.motor = MotorControl::pwm;
  return facts;
}

ScanPlan plan_scan(const DeviceFacts& facts, const std::string& mode_name, double scan_frequency) {
  const ScanMode* mode = find_mode(facts, mode_name);
  if (!mode) {
    throw SettingsError(
        {.finding = Finding::unknown_scan_mode,
         .text = facts.endpoint + ": " + model_text(facts.info) + " has no scan mode " +
                 (mode_name.empty() ? "that is typical and can be read" : excerpt(mode_name)),
         .advice = "choose one of: " + names_of(facts.modes)});
  }
  if (mode->range_max <= 0.0) {
    throw DeviceError(
        wrong_value(facts.endpoint, "no usable range of scan mode " + excerpt(mode->name)));
  }
  ScanPlan plan{.mode = *mode, .speed = plan_speed(facts, scan_frequency), .warning = {}};
  if (scan_frequency != 0.0 && !plan.speed) {
    plan.warning = {.finding = Finding::speed_out_of_range,
                    .text = facts.endpoint + ": scan frequency " + short_number(scan_frequency) +
                            " Hz: the speed of " + model_text(facts.info) +
                            " cannot be set, it turns at its own",
                    .advice = "leave it out"};
  }
  return plan;
}

}  // namespace quoin::sensor_bridge::rplidar
