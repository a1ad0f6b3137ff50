// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sensor_bridge/recordings/recorded_scan.hpp"

namespace quoin::sensor_bridge {

/// Messages that say where the robot is by its wheels.
enum class OdometryMessage {
  ros1_odometry,  ///< nav_msgs/Odometry as ROS 1 serialises it
  ros2_odometry,  ///< the same as CDR
  quoin_odometry  ///< quoin::msg::Odometry as CDR
};

/// What a topic of this type and encoding (cdr, ros1) holds; nothing when it is no odometry.
[[nodiscard]] std::optional<OdometryMessage> odometry_message(std::string_view type,
                                                              std::string_view encoding);

/// Reads the pose in the plane with its covariance. Returns what is wrong with the bytes, which
/// anybody may have written; "" when nothing is.
[[nodiscard]] std::string read_odometry_message(OdometryMessage kind, std::string_view bytes,
                                                RecordedOdometry& odometry);

}  // namespace quoin::sensor_bridge
