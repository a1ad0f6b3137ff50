// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/parameters/parameter.hpp"
#include "core/sensor/sensor_fields.hpp"
#include "sensor_bridge/mounting.hpp"

namespace quoin::sensor_bridge {

/// How a topic of ROS 2 is read.
enum class Reliability {
  best_effort,  ///< of every writer
  reliable,     ///< of reliable writers, nothing lost
};

/// Which ray the stamp of a scan belongs to.
enum class StampOf { first_ray, last_ray };

}  // namespace quoin::sensor_bridge

namespace quoin {

template <>
struct EnumNames<sensor_bridge::Reliability> {
  static constexpr std::array<std::pair<sensor_bridge::Reliability, std::string_view>, 2> names{
      {{sensor_bridge::Reliability::best_effort, "best_effort"},
       {sensor_bridge::Reliability::reliable, "reliable"}}};
};

template <>
struct EnumNames<sensor_bridge::StampOf> {
  static constexpr std::array<std::pair<sensor_bridge::StampOf, std::string_view>, 2> names{
      {{sensor_bridge::StampOf::first_ray, "first_ray"},
       {sensor_bridge::StampOf::last_ray, "last_ray"}}};
};

}  // namespace quoin

namespace quoin::sensor_bridge {

/// Parameters of scans that a driver publishes as sensor_msgs/LaserScan.
struct Ros2ScanParameters : SensorDeclaration, Mounting {
  std::string topic = "/scan";
  Reliability reliability = Reliability::best_effort;
  StampOf stamp = StampOf::first_ray;
  std::string frame;
  double range_min = 0.0;    ///< [m]
  double range_max = 1.0e4;  ///< [m]

  static constexpr auto fields() {
    using P = Ros2ScanParameters;
    const std::tuple own{
        field(&P::topic, "topic", "topic of sensor_msgs/LaserScan, as ROS 2 names it"),
        field(&P::reliability, "reliability",
              "best_effort: gets messages of any QoS; reliable: of reliable writers, all of them"),
        field(&P::stamp, "stamp",
              "ray that was measured at the stamp; the message definition says the first"),
        field(&P::frame, "frame",
              "frame of the sensor (REP-105), scans of others are left out; empty is that of each "
              "message"),
        field(&P::range_min, "range_min", "m", 0.0, 1000.0,
              "shorter ranges are too close, whatever the messages say"),
        field(&P::range_max, "range_max", "m", 0.01, 10000.0,
              "longer ranges are no return, whatever the messages say")};
    return std::tuple_cat(own, mounting_fields<P>(), sensor_fields<P>());
  }
};

}  // namespace quoin::sensor_bridge
