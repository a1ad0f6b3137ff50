// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

#include "core/simulation/random.hpp"
#include "core/simulation/world.hpp"
#include "sensor_bridge/rplidar/emulator/emulator_settings.hpp"

namespace quoin::sensor_bridge::rplidar {

/// What the device's range finder sees of the world.
class RangeFinder {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// The sensor starts along the world's path at `start`.
  RangeFinder(World world, const EmulatorSettings& settings, TimePoint start);

  /// [m] from the sensor to what it sees at `time` in the direction of `angle` [rad], clockwise
  /// from its front; +inf when there is nothing.
  [[nodiscard]] double distance(double angle, TimePoint time) const;

  /// Range [1/4 mm] at `time` in that direction, with noise; 0 without a return or out of limits.
  /// Takes the same number of random numbers each time.
  [[nodiscard]] std::uint32_t measure(double angle, TimePoint time);

 private:
  World world_;
  double speed_;
  double range_min_;
  double range_max_;
  double range_stddev_;
  TimePoint start_;
  Random random_;
};

}  // namespace quoin::sensor_bridge::rplidar
