// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/simulation/scanner.hpp"
#include "core/simulation/world.hpp"
#include "sensor_bridge/rplidar/emulator/emulated_device.hpp"
#include "sensor_bridge/rplidar/emulator/seconds.hpp"
#include "tests/sensor_bridge/rplidar/protocol/hex.hpp"

namespace quoin::sensor_bridge::rplidar {

/// A room without symmetry, all of it in reach.
inline World small_room() {
  World world;
  world.name = "small_room";
  world.add_polyline({{0.0, 0.0}, {6.0, 0.0}, {6.0, 3.0}, {4.5, 3.5}, {0.0, 3.5}}, true);
  world.path = {{2.0, 1.0, 0.4}, {3.0, 2.0, 0.9}};
  return world;
}

inline EmulatorSettings without_noise() {
  EmulatorSettings settings;
  settings.range_stddev = 0.0;
  return settings;
}

/// A device with a clock that the test turns.
class DeviceOnBench {
 public:
  using TimePoint = EmulatedDevice::TimePoint;

  explicit DeviceOnBench(const EmulatorSettings& settings = without_noise(),
                         const World& world = small_room())
      : device_(settings, world, now_, [this](TimePoint time, const std::string& what) {
          events_.push_back(std::to_string(std::llround(1e3 * seconds_between(start, time))) +
                            " ms " + what);
        }) {}

  /// What the device has sent when `time` [s] has gone by.
  Bytes wait(double time) {
    now_ += duration_of(time);
    Bytes bytes;
    device_.send(now_, bytes);
    return bytes;
  }

  /// What it has sent a tenth of a second after these bytes.
  Bytes ask(std::span<const std::uint8_t> request, double time = 0.1) {
    device_.receive(request, now_);
    return wait(time);
  }
  Bytes ask(std::string_view request, double time = 0.1) { return ask(hex(request), time); }

  void apply(std::string_view fault) { device_.apply(parse_faults(fault).at(0), now_); }

  [[nodiscard]] EmulatedDevice& device() { return device_; }
  [[nodiscard]] TimePoint now() const { return now_; }
  [[nodiscard]] double time() const { return seconds_between(start, now_); }
  [[nodiscard]] const std::vector<std::string>& events() const { return events_; }

  static constexpr TimePoint start{std::chrono::hours(1)};

 private:
  TimePoint now_ = start;
  std::vector<std::string> events_;
  EmulatedDevice device_;
};

inline constexpr std::string_view scan_request = "A5 20";
inline constexpr std::string_view dense_scan_request = "A5 82 05 01 00 00 00 00 23";
inline constexpr std::string_view stop_request = "A5 25";

}  // namespace quoin::sensor_bridge::rplidar
