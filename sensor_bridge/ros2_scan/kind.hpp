// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_bridge/ros2_scan/parameters.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::sensor_bridge {

[[nodiscard]] inline const KindInfo& ros2_scan_kind() {
  static const KindInfo kind{.name = "ros2_scan",
                             .description = "scans of a ROS 2 topic (sensor_msgs/LaserScan)",
                             .program = "quoin-ros2-scan",
                             .outputs = {{"scan"}},
                             .parameters = describe_parameters<Ros2ScanParameters>()};
  return kind;
}

}  // namespace quoin::sensor_bridge
