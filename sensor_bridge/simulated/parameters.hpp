// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "core/parameters/parameter.hpp"
#include "core/sensor/sensor_fields.hpp"
#include "core/simulation/scanner.hpp"
#include "core/simulation/wheel_odometry.hpp"
#include "sensor_bridge/mounting.hpp"

namespace quoin::sensor_bridge {

/// Parameters of the simulated sensor. It has the noise of range and bearing that it declares. The
/// defaults are an RPLIDAR S1 at 10 Hz: 9200 samples a second, range noise of 1 cm, bearings in
/// steps of 0.391 deg.
struct SimulatedParameters : SensorDeclaration, Mounting {
  std::string environment = "domestic_room";
  double rate_hz = 10.0;                     ///< [Hz]
  std::int64_t points = 920;                 ///< rays per revolution
  std::int64_t seed = 1;                     ///< same seed, same scans
  double speed = 0.0;                        ///< [m/s]
  std::int64_t scans = 0;                    ///< 0: endless
  double field_of_view = 6.283185307179586;  ///< [rad]
  double range_min = 0.1;                    ///< [m]
  double range_max = 40.0;                   ///< [m]
  double range_bias = 0.0;                   ///< [m]
  double dropout = 0.0;                      ///< probability
  std::string frame = "laser";
  bool odometry = false;
  bool truth = false;
  double odometry_rate_hz = 50.0;   ///< [Hz]
  double wheel_slip = 0.02;         ///< the wheels count so much more than was driven
  double wheel_heading_bias = 0.0;  ///< [rad/m]
  double wheel_noise = 1.0;         ///< factor on that of OdometryNoise
  std::string base_frame = "base_link";
  std::string odometry_frame = "odom";
  std::string map_frame = "map";

  static constexpr auto fields() {
    using P = SimulatedParameters;
    const std::tuple own{
        field(
            &P::environment, "environment",
            "name of a built-in world, or path of a world file (relative to the deployment file)"),
        field(&P::rate_hz, "rate_hz", "Hz", 0.1, 1000.0, "revolutions a second"),
        field(&P::points, "points", "", 3.0, 100000.0, "rays per revolution"),
        // 2^53: larger integers do not survive a double, which YAML and JSON readers may use.
        field(&P::seed, "seed", "", 0.0, 9007199254740992.0, "seed of the noise"),
        field(&P::speed, "speed", "m/s", 0.0, 100.0,
              "speed along the world's path, there and back"),
        field(&P::scans, "scans", "", 0.0, 9007199254740992.0,
              "scans to publish before ending; 0 never ends"),
        field(&P::field_of_view, "field_of_view", "rad", 0.001, 6.2832,
              "swept angle, centred on the x axis"),
        field(&P::range_min, "range_min", "m", 0.0, 1000.0, "shortest range that is measured"),
        field(&P::range_max, "range_max", "m", 0.01, 10000.0, "longest range that is measured"),
        field(&P::range_bias, "range_bias", "m", -1.0, 1.0, "error that is added to every range"),
        field(&P::dropout, "dropout", "", 0.0, 1.0, "probability that a ray gives no range"),
        field(&P::frame, "frame", "frame of the sensor, which is in the middle of the robot"),
        field(&P::odometry, "odometry", "publish what the wheels of the robot count, too"),
        field(&P::truth, "truth", "publish the true pose of the robot at each scan, too"),
        field(&P::odometry_rate_hz, "odometry_rate_hz", "Hz", 0.1, 1000.0,
              "messages of odometry a second"),
        field(&P::wheel_slip, "wheel_slip", "", -0.5, 0.5,
              "part by which the wheels count more than was driven"),
        field(&P::wheel_heading_bias, "wheel_heading_bias", "rad/m", -1.0, 1.0,
              "by how much the wheels turn the robot wrongly on the way"),
        field(&P::wheel_noise, "wheel_noise", "", 0.0, 100.0,
              "factor on the noise of what the wheels count: 2 % of the way, 1 % across it, 0.01 "
              "rad/m, 3 % of turns"),
        field(&P::base_frame, "base_frame", "frame of the robot"),
        field(&P::odometry_frame, "odometry_frame", "frame in which odometry is given"),
        field(&P::map_frame, "map_frame", "frame of the true pose: that of the world")};
    return std::tuple_cat(own, mounting_fields<P>(), sensor_fields<P>());
  }
};

/// The scanner that `parameters` describe. Throws ParameterError when they contradict each other.
[[nodiscard]] ScannerSettings scanner_settings(const SimulatedParameters& parameters);

/// The wheels that `parameters` describe.
[[nodiscard]] WheelErrors wheel_errors(const SimulatedParameters& parameters);

}  // namespace quoin::sensor_bridge
