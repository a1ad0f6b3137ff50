// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <ostream>
#include <vector>

#include <nlohmann/json.hpp>

#include "sensor_bridge/rplidar/driver/measurement.hpp"
#include "sensor_bridge/rplidar/driver/probe.hpp"
#include "sensor_bridge/transport/serial_ports.hpp"

namespace quoin::deploy {

/// What was learned of one endpoint.
struct LidarReport {
  sensor_bridge::rplidar::ProbeReport probe;
  std::optional<sensor_bridge::rplidar::Measurement> measurement;  ///< if it was let measure

  [[nodiscard]] bool found() const { return probe.facts.has_value(); }
};

void print(const LidarReport& report, std::ostream& out);
[[nodiscard]] nlohmann::ordered_json to_json(const LidarReport& report);

void print(const std::vector<sensor_bridge::SerialPortEntry>& ports, std::ostream& out);
[[nodiscard]] nlohmann::ordered_json to_json(
    const std::vector<sensor_bridge::SerialPortEntry>& ports);

}  // namespace quoin::deploy
