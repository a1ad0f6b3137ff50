// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/fault.hpp"

#include <cmath>
#include <cstdio>

#include "core/parameters/parameter.hpp"
#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

// A value is required where smallest < largest and there is no usual one.
struct Description {
  FaultKind kind;
  std::string_view name;
  std::string_view value;  // what the value is; empty when there is none
  double smallest = 0.0;
  double largest = 0.0;
  std::optional<double> usual = std::nullopt;
};

constexpr Description descriptions[] = {
    {FaultKind::silence, "silence", ""},
    {FaultKind::garbage, "garbage", ""},
    {FaultKind::wrong_checksums, "wrong_checksums", "share of the frames", 0.0, 1.0},
    {FaultKind::dropped_bytes, "dropped_bytes", "share of the bytes", 0.0, 1.0},
    {FaultKind::flipped_bits, "flipped_bits", "share of the bits", 0.0, 1.0},
    {FaultKind::lost_frames, "lost_frames", "share of the frames", 0.0, 1.0},
    {FaultKind::repeated_frames, "repeated_frames", "share of the frames", 0.0, 1.0},
    {FaultKind::swapped_frames, "swapped_frames", "share of the frames", 0.0, 1.0},
    {FaultKind::second_device, "second_device", ""},
    {FaultKind::wrong_format, "wrong_format", ""},
    {FaultKind::slow_spin_up, "slow_spin_up", "seconds from rest to 10 Hz", 0.0, 3600.0, 10.0},
    {FaultKind::health_error, "health_error", "number of resets that end it", 1.0, 1e6, 1.0},
    {FaultKind::unplug, "unplug", ""},
    {FaultKind::speed, "speed", "revolutions per second", 0.0, 30.0},
    {FaultKind::zero_sample_time, "zero_sample_time", ""},
    {FaultKind::wrong_length, "wrong_length", ""},
    {FaultKind::long_answers, "long_answers", ""},
    {FaultKind::slow_answers, "slow_answers", "seconds", 0.0, 60.0, 0.6},
    {FaultKind::health_warning, "health_warning", "error code", 0.0, 65535.0, 1.0},
    {FaultKind::unknown_model, "unknown_model", ""},
    {FaultKind::unknown_format, "unknown_format", ""},
};

constexpr double longest_time = 1e6;  // [s]

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) {
    text.remove_suffix(1);
  }
  return text;
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

[[noreturn]] void fail(std::string_view fault, const std::string& what) {
  throw FaultError("fault " + excerpt(fault) + ": " + what);
}

double parse_time(std::string_view fault, std::string_view text) {
  double unit = 0.0;
  std::string_view digits = text;
  if (text.ends_with("ms")) {
    unit = 1e-3;
    digits.remove_suffix(2);
  } else if (text.ends_with("min")) {
    unit = 60.0;
    digits.remove_suffix(3);
  } else if (text.ends_with("s")) {
    unit = 1.0;
    digits.remove_suffix(1);
  }
  const std::optional<double> number = sensor_bridge::parse_number<double>(digits);
  if (!number || unit == 0.0) {
    fail(fault, excerpt(text) + " is no time; write it like 5s, 200ms or 2min");
  }
  const double time = *number * unit;
  if (!(time >= 0.0 && time <= longest_time)) {
    fail(fault, excerpt(text) + " is not between 0 s and " + number_text(longest_time) + " s");
  }
  return time;
}

const Description& describe(std::string_view fault, std::string_view name) {
  for (const Description& description : descriptions) {
    if (description.name == name) return description;
  }
  fail(fault, "unknown kind " + excerpt(name) + suggestion(name, fault_names()));
}

double parse_value(std::string_view fault, const Description& description,
                   const std::optional<std::string_view>& text) {
  const std::string name(description.name);
  if (description.value.empty()) {
    if (text) fail(fault, name + " takes no value; leave out '=" + std::string(*text) + "'");
    return 0.0;
  }
  const std::string range = std::string(description.value) + ", " +
                            number_text(description.smallest) + " to " +
                            number_text(description.largest);
  if (!text) {
    if (description.usual) return *description.usual;
    fail(fault, name + " needs a value (" + range + "): " + name + "=...");
  }
  const std::optional<double> value = sensor_bridge::parse_number<double>(*text);
  if (!value || !(*value >= description.smallest && *value <= description.largest)) {
    fail(fault, excerpt(*text) + " is no value of " + name + " (" + range + ")");
  }
  if (description.kind == FaultKind::health_error && *value != std::floor(*value)) {
    fail(fault, excerpt(*text) + " is no whole number of resets");
  }
  return *value;
}

// Cuts off what follows the first `mark`.
std::optional<std::string_view> take_after(std::string_view& text, char mark) {
  const std::size_t position = text.find(mark);
  if (position == std::string_view::npos) return std::nullopt;
  const std::string_view after = text.substr(position + 1);
  text = text.substr(0, position);
  return trimmed(after);
}

Fault parse_fault(std::string_view text) {
  std::string_view rest = text;
  Fault fault;
  if (const auto duration = take_after(rest, '+')) fault.duration = parse_time(text, *duration);
  if (const auto begin = take_after(rest, '@')) fault.begin = parse_time(text, *begin);
  const auto value = take_after(rest, '=');
  const Description& description = describe(text, trimmed(rest));
  fault.kind = description.kind;
  fault.value = parse_value(text, description, value);
  return fault;
}

}  // namespace

std::vector<std::string> fault_names() {
  std::vector<std::string> names;
  for (const Description& description : descriptions) names.emplace_back(description.name);
  return names;
}

std::vector<Fault> parse_faults(std::string_view text) {
  std::vector<Fault> faults;
  if (trimmed(text).empty()) return faults;
  for (;;) {
    const std::size_t comma = text.find(',');
    const std::string_view one = trimmed(text.substr(0, comma));
    if (one.empty()) throw FaultError("faults: nothing between two commas; remove one");
    faults.push_back(parse_fault(one));
    if (comma == std::string_view::npos) return faults;
    text.remove_prefix(comma + 1);
  }
}

Fault parse_typed_fault(std::string_view line) {
  line = trimmed(line);
  const std::size_t space = line.find_first_of(" \t");
  Fault fault = parse_fault(line.substr(0, space));
  if (space == std::string_view::npos) return fault;
  const std::string_view duration = trimmed(line.substr(space));
  if (fault.duration) fail(line, "it has two durations; leave out " + excerpt(duration));
  fault.duration = parse_time(line, duration);
  return fault;
}

std::string fault_text(const Fault& fault) {
  std::string text;
  for (const Description& description : descriptions) {
    if (description.kind != fault.kind) continue;
    text = description.name;
    if (!description.value.empty()) text += "=" + number_text(fault.value);
  }
  if (fault.begin > 0.0) text += "@" + number_text(fault.begin) + "s";
  if (fault.duration) text += "+" + number_text(*fault.duration) + "s";
  return text;
}

}  // namespace quoin::sensor_bridge::rplidar
