// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/ros2/DiagnosticMsgs.h>
#include <idl/ros2/GeometryMsgs.h>
#include <idl/ros2/NavMsgs.h>
#include <idl/ros2/RmwDdsCommon.h>
#include <idl/ros2/SensorMsgs.h>
#include <idl/ros2/VisualizationMsgs.h>
#include <string>
#include <string_view>

namespace quoin::ros2 {

using LaserScan = sensor_msgs::msg::dds_::LaserScan_;
using Marker = visualization_msgs::msg::dds_::Marker_;
using MarkerArray = visualization_msgs::msg::dds_::MarkerArray_;
using PoseWithCovarianceStamped = geometry_msgs::msg::dds_::PoseWithCovarianceStamped_;
using TransformStamped = geometry_msgs::msg::dds_::TransformStamped_;
using Odometry = nav_msgs::msg::dds_::Odometry_;
using OccupancyGrid = nav_msgs::msg::dds_::OccupancyGrid_;
using TFMessage = tf2_msgs::msg::dds_::TFMessage_;
using DiagnosticArray = diagnostic_msgs::msg::dds_::DiagnosticArray_;
using DiagnosticStatus = diagnostic_msgs::msg::dds_::DiagnosticStatus_;

using Header = std_msgs::msg::dds_::Header_;
using Time = builtin_interfaces::msg::dds_::Time_;

inline constexpr std::int64_t nanoseconds_a_second = 1'000'000'000;

/// [ns since the epoch of the sender's clock].
[[nodiscard]] inline std::int64_t nanoseconds(const Time& time) {
  return time.sec() * nanoseconds_a_second + time.nanosec();
}

/// `stamp` [ns]; ROS 2 has 32 bits of seconds.
inline void set_header(Header& header, std::int64_t stamp, std::string_view frame) {
  std::int64_t seconds = stamp / nanoseconds_a_second;
  std::int64_t rest = stamp % nanoseconds_a_second;
  if (rest < 0) {
    --seconds;
    rest += nanoseconds_a_second;
  }
  header.stamp().sec(static_cast<std::int32_t>(seconds));
  header.stamp().nanosec(static_cast<std::uint32_t>(rest));
  header.frame_id(std::string(frame));
}

}  // namespace quoin::ros2
