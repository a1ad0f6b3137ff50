// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sensor_bridge/rplidar/driver/connection.hpp"
#include "sensor_bridge/rplidar/driver/device_facts.hpp"
#include "sensor_bridge/rplidar/driver/diagnosis.hpp"
#include "sensor_bridge/rplidar/driver/driver_listener.hpp"
#include "sensor_bridge/rplidar/driver/interruption.hpp"

namespace quoin::sensor_bridge::rplidar {

/// What a device did in a trial run.
struct Measurement {
  std::size_t revolutions = 0;
  double frequency = 0.0;        ///< [Hz] of the median revolution: a lost frame may join two
  double sample_rate = 0.0;      ///< [1/s]
  double return_share = 0.0;     ///< of samples with a range, 0..1
  std::optional<ScanPlan> plan;  ///< nothing when no device was found
  DriverCounts counts;
  std::vector<Diagnosis> problems;
};

/// Runs the device until so many revolutions were seen, `time_limit` is over or the program is to
/// stop. Its motor is stopped afterwards. Problems that end the run are among its problems.
[[nodiscard]] Measurement measure(const DriverSettings& settings, std::size_t revolutions,
                                  TimeOuts::Time time_limit, const Interruption& interruption,
                                  Opener open = {});

}  // namespace quoin::sensor_bridge::rplidar
