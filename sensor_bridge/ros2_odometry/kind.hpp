// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <tuple>

#include "core/parameters/parameter.hpp"
#include "sensor_bridge/ros2_scan/parameters.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::sensor_bridge {

/// Parameters of the odometry that a robot publishes as nav_msgs/Odometry.
struct Ros2OdometryParameters {
  std::string topic = "/odom";
  Reliability reliability = Reliability::best_effort;

  static constexpr auto fields() {
    using P = Ros2OdometryParameters;
    return std::tuple{
        field(&P::topic, "topic", "topic of nav_msgs/Odometry, as ROS 2 names it"),
        field(&P::reliability, "reliability",
              "best_effort: gets messages of any QoS; reliable: of reliable writers, all of them")};
  }
};

[[nodiscard]] inline const KindInfo& ros2_odometry_kind() {
  static const KindInfo kind{.name = "ros2_odometry",
                             .description = "odometry of a ROS 2 topic (nav_msgs/Odometry)",
                             .program = "quoin-ros2-odometry",
                             .outputs = {{"odometry", Rate::own_rate}},
                             .parameters = describe_parameters<Ros2OdometryParameters>()};
  return kind;
}

}  // namespace quoin::sensor_bridge
