// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/odometry_message.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <stdexcept>

#include "sensor_bridge/recordings/ros1_cursor.hpp"
#include "services/topics/cdr_cursor.hpp"

namespace quoin::sensor_bridge {

namespace {

using topics::CdrCursor;

void set_odometry_stamp(std::int64_t stamp, RecordedOdometry& odometry) {
  odometry.epoch_stamp = stamp;
  odometry.stamp = static_cast<double>(stamp) * 1e-9;
}

/// nav_msgs/Odometry: header, child_frame_id, pose with covariance, twist with covariance.
template <class Cursor>
void read_ros_odometry(Cursor& cursor, bool numbered, RecordedOdometry& odometry) {
  const auto numbers = [&](auto& values) {
    for (double& value : values) value = cursor.template primitive<double>();
  };
  const RosHeader header = read_ros_header(cursor, numbered);
  set_odometry_stamp(header.stamp, odometry);
  odometry.frame = header.frame;
  odometry.child_frame = cursor.string(0);
  std::array<double, 3> position{};
  std::array<double, 4> rotation{};  // x, y, z, w
  std::array<double, 36> covariance{};
  numbers(position);
  numbers(rotation);
  numbers(covariance);
  const auto [x, y, z, w] = rotation;
  const double square = x * x + y * y + z * z + w * w;
  // Messages that were never filled in have the quaternion 0.
  if (!(square > 0.25 && square < 4.0)) throw std::runtime_error("its rotation is none");
  const double theta = std::atan2(2.0 * (w * z + x * y), square - 2.0 * (y * y + z * z));
  odometry.pose = {position[0], position[1], theta};
  if (covariance[0] > 0.0) {  // by convention -1 where it is not known
    constexpr std::array<std::size_t, 3> rows{0, 1, 5};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        odometry.covariance(static_cast<int>(i), static_cast<int>(j)) =
            covariance[rows[i] * 6 + rows[j]];
      }
    }
  }
  std::array<double, 6> twist{};
  numbers(twist);
  numbers(covariance);
  cursor.finish();
  if (covariance[0] >= 0.0) odometry.velocity = Eigen::Vector3d(twist[0], twist[1], twist[5]);
}

/// quoin::msg::Odometry (idl/Odometry.idl).
void read_quoin_odometry(CdrCursor& cursor, RecordedOdometry& odometry) {
  const auto number = [&] { return cursor.primitive<double>(); };
  for (std::size_t i = cursor.sequence_length(0); i > 0; --i) {  // origins
    (void)cursor.string(0);
    for (int value = 0; value < 2; ++value) (void)cursor.primitive<std::uint64_t>();
    for (int value = 0; value < 2; ++value) (void)cursor.primitive<std::uint32_t>();
  }
  set_odometry_stamp(cursor.primitive<std::int64_t>(), odometry);
  odometry.frame = cursor.string(0);
  for (std::size_t i = cursor.sequence_length(0); i > 0; --i) {  // trace
    for (int text = 0; text < 3; ++text) (void)cursor.string(0);
    for (int time = 0; time < 4; ++time) (void)cursor.primitive<std::uint64_t>();
  }
  odometry.child_frame = cursor.string(0);
  odometry.pose.x = number();
  odometry.pose.y = number();
  odometry.pose.theta = number();
  Eigen::Matrix3d& covariance = odometry.covariance;
  covariance(0, 0) = number();
  covariance(0, 1) = covariance(1, 0) = number();
  covariance(1, 1) = number();
  covariance(0, 2) = covariance(2, 0) = number();
  covariance(1, 2) = covariance(2, 1) = number();
  covariance(2, 2) = number();
  const bool known = cursor.boolean();
  Eigen::Vector3d velocity;
  for (double& value : velocity) value = number();
  if (known) odometry.velocity = velocity;
  cursor.finish();
}

}  // namespace

std::optional<OdometryMessage> odometry_message(std::string_view type, std::string_view encoding) {
  constexpr std::array names{"nav_msgs/Odometry", "nav_msgs/msg/Odometry",
                             "nav_msgs::msg::Odometry", "nav_msgs::msg::dds_::Odometry_"};
  for (const std::string_view name : names) {
    if (type != name) continue;
    if (encoding == "ros1") return OdometryMessage::ros1_odometry;
    if (encoding == "cdr") return OdometryMessage::ros2_odometry;
  }
  if (type == "quoin::msg::Odometry" && encoding == "cdr") return OdometryMessage::quoin_odometry;
  return std::nullopt;
}

std::string read_odometry_message(OdometryMessage kind, std::string_view bytes,
                                  RecordedOdometry& odometry) {
  odometry = {};
  try {
    if (kind == OdometryMessage::ros1_odometry) {
      Ros1Cursor cursor(bytes);
      read_ros_odometry(cursor, true, odometry);
    } else {
      CdrCursor cursor("Odometry", std::as_bytes(std::span(bytes.data(), bytes.size())));
      if (kind == OdometryMessage::quoin_odometry) {
        read_quoin_odometry(cursor, odometry);
      } else {
        read_ros_odometry(cursor, false, odometry);
      }
    }
    const Pose2& pose = odometry.pose;
    if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.theta)) {
      throw std::runtime_error("its pose is not finite");
    }
    if (!odometry.covariance.allFinite()) throw std::runtime_error("its covariance is not finite");
    return "";
  } catch (const std::exception& error) {
    odometry = {};
    return std::string("odometry that cannot be read: ") + error.what();
  }
}

}  // namespace quoin::sensor_bridge
