// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "core/mapping/localizers.hpp"
#include "core/parameters/method_list.hpp"
#include "services/deployment/kind.hpp"

namespace quoin {

/// The map of the PCA paper: angular_offsets by the name of its rule for maps.
class LineMerge : public AngularOffsets {
 public:
  using AngularOffsets::AngularOffsets;
  static constexpr const char* name = "line_merge";
  static constexpr const char* description =
      "joins each line with the nearest mapped one of about its direction; odometry with the "
      "heading of the mapped lines";
};

/// The methods of kind mapping.
using Mappers = MethodList<Landmarks, LineMerge>;

/// What mapping and localization have beside the parameters of their methods: frames, and what is
/// known of the robot.
struct RobotParameters {
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  double mounting_x = 0.0;          ///< [m]
  double mounting_y = 0.0;          ///< [m]
  double mounting_yaw = 0.0;        ///< [rad]
  double start_x = 0.0;             ///< [m]
  double start_y = 0.0;             ///< [m]
  double start_yaw = 0.0;           ///< [rad]
  double odometry_noise = 1.0;      ///< factor on that of OdometryNoise
  double largest_speed = 10.0;      ///< [m/s]
  double largest_turn_rate = 15.0;  ///< [rad/s]

  [[nodiscard]] Pose2 mounting() const { return {mounting_x, mounting_y, mounting_yaw}; }
  [[nodiscard]] Pose2 start() const { return {start_x, start_y, start_yaw}; }
};

/// Descriptions of these, for parameters `P` that derive from them.
template <class P>
[[nodiscard]] constexpr auto robot_fields() {
  constexpr double far = 1e6;
  return std::tuple{
      field<P, std::string>(&P::map_frame, "map_frame", "frame of the map (REP-105)"),
      field<P, std::string>(&P::base_frame, "base_frame", "frame of the robot, whose pose it is"),
      field<P, double>(&P::mounting_x, "mounting_x", "m", -100.0, 100.0,
                       "place of the sensor on the robot, forward of base_frame"),
      field<P, double>(&P::mounting_y, "mounting_y", "m", -100.0, 100.0, "to the left of it"),
      field<P, double>(&P::mounting_yaw, "mounting_yaw", "rad", -6.2832, 6.2832,
                       "direction of the sensor's x axis on the robot"),
      field<P, double>(&P::start_x, "start_x", "m", -far, far,
                       "where the robot is in the map at the first scan"),
      field<P, double>(&P::start_y, "start_y", "m", -far, far, "likewise"),
      field<P, double>(&P::start_yaw, "start_yaw", "rad", -6.2832, 6.2832, "its heading there"),
      field<P, double>(&P::odometry_noise, "odometry_noise", "", 0.01, 1000.0,
                       "factor on the noise of odometry that does not say how good it is: 2 % of "
                       "the way, 1 % across it, 0.01 rad/m, 3 % of turns"),
      field<P, double>(&P::largest_speed, "largest_speed", "m/s", 0.01, 1000.0,
                       "odometry that is faster jumps: it is not used"),
      field<P, double>(&P::largest_turn_rate, "largest_turn_rate", "rad/s", 0.01, 1000.0,
                       "likewise")};
}

/// Of kind mapping.
struct MappingParameters : RobotParameters {
  std::string map;

  static constexpr auto fields() {
    return std::tuple_cat(
        std::tuple{field(&MappingParameters::map, "map",
                         "file (.qmap) that the map is kept in and goes on from, relative to the "
                         "deployment file; none: it is forgotten at the end")},
        robot_fields<MappingParameters>());
  }
};

/// Of kind localization.
struct GivenMapParameters : RobotParameters {
  std::string map;
  bool start_known = false;
  double start_stddev = 0.3;      ///< [m]
  double start_yaw_stddev = 0.1;  ///< [rad]
  double map_scale = 1.0;         ///< [m]

  static constexpr auto fields() {
    using P = GivenMapParameters;
    return std::tuple_cat(
        std::tuple{
            required_field(&P::map, "map",
                           "file of the map, relative to the deployment file: .qmap of kind "
                           "mapping, .svg or .dxf with the lines of a plan, or the .yaml of an "
                           "occupancy grid as map_server has it"),
            field(&P::map_scale, "map_scale", "m", 1e-6, 1e6,
                  "length of one unit of an .svg or of a .dxf that names no unit"),
            field(&P::start_known, "start_known",
                  "true: the robot begins at start_x, start_y, start_yaw; false: its place is "
                  "found by what it sees"),
            field(&P::start_stddev, "start_stddev", "m", 0.001, 100.0,
                  "how well that place is known"),
            field(&P::start_yaw_stddev, "start_yaw_stddev", "rad", 0.001, 6.3,
                  "how well the heading is known")},
        robot_fields<P>());
  }
};

/// Ports of both kinds.
[[nodiscard]] inline std::vector<InputPort> localizer_inputs() {
  return {{"lines", "lines"},
          {"odometry", "odometry", Join::by_time, false},
          {"segments", "segments", Join::by_time, false}};
}

/// Methods that have these parameters beside their own.
[[nodiscard]] inline std::vector<MethodInfo> with_parameters(
    std::vector<MethodInfo> methods, const std::vector<ParameterInfo>& parameters) {
  for (MethodInfo& method : methods) {
    method.parameters.insert(method.parameters.begin(), parameters.begin(), parameters.end());
  }
  return methods;
}

}  // namespace quoin
