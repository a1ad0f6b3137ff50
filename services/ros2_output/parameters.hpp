// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "core/parameters/parameter.hpp"

namespace quoin {

/// What goes out to ROS 2, and how.
struct Ros2OutputParameters {
  std::string prefix;             ///< of all topics but /tf, /tf_static and /diagnostics
  std::int64_t beams = 0;         ///< of LaserScans; 0: as many as the first scan has rays
  double marker_width = 0.03;     ///< [m]
  double marker_lifetime = 1.0;   ///< [s]
  double grid_resolution = 0.05;  ///< [m]
  bool numbers = true;
  bool diagnostics = true;
  bool pose_tf = true;
  bool odometry_tf = false;
  double transform_tolerance = 0.0;  ///< [s]
  std::string base_frame;
  double mounting_x = 0.0;    ///< [m]
  double mounting_y = 0.0;    ///< [m]
  double mounting_z = 0.0;    ///< [m]
  double mounting_yaw = 0.0;  ///< [rad]

  static constexpr auto fields() {
    using P = Ros2OutputParameters;
    return std::tuple{
        field(&P::prefix, "prefix",
              "first part of the topics, <prefix>/<service>/...; empty is the namespace of the "
              "deployment"),
        field(&P::beams, "beams", "", 0.0, 100000.0,
              "beams of every LaserScan; 0 is as many as the first scan has rays"),
        field(&P::marker_width, "marker_width", "m", 0.001, 1.0, "width of lines and points"),
        field(&P::marker_lifetime, "marker_lifetime", "s", 0.0, 3600.0,
              "time after which viewers take markers away that are not renewed; 0 is never"),
        field(&P::grid_resolution, "grid_resolution", "m", 0.005, 1.0,
              "size of the cells of an OccupancyGrid"),
        field(&P::numbers, "numbers",
              "publish the messages of quoin_msgs (idl/ros2/quoin_msgs), too, with all values and "
              "covariances"),
        field(&P::diagnostics, "diagnostics", "publish the heartbeats of all services"),
        field(&P::pose_tf, "pose_tf",
              "publish the transform from the map: to odom where odometry is among the inputs, "
              "else to the robot"),
        field(&P::odometry_tf, "odometry_tf",
              "publish the transform of odometry, too; not where it came from ROS 2, which has it"),
        field(&P::transform_tolerance, "transform_tolerance", "s", 0.0, 10.0,
              "the transform from the map is dated later by this, for those who ask for it before "
              "the next comes"),
        field(&P::base_frame, "base_frame",
              "frame of the robot, of which the place of the sensor is published; empty is not"),
        field(&P::mounting_x, "mounting_x", "m", -100.0, 100.0, "place of the sensor on the robot"),
        field(&P::mounting_y, "mounting_y", "m", -100.0, 100.0, "likewise"),
        field(&P::mounting_z, "mounting_z", "m", -100.0, 100.0, "likewise"),
        field(&P::mounting_yaw, "mounting_yaw", "rad", -6.2832, 6.2832,
              "direction of the sensor on the robot")};
  }
};

}  // namespace quoin
