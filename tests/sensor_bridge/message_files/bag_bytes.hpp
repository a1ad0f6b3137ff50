// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sensor_bridge/message_files/rosbag.hpp"

namespace quoin::tests {

/// The bytes of a number, little-endian.
template <class T>
[[nodiscard]] std::string bytes_of(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}
[[nodiscard]] inline std::string with_length(const std::string& text) {
  return bytes_of(static_cast<std::uint32_t>(text.size())) + text;
}

/// A record of a ROS 1 bag.
[[nodiscard]] inline std::string bag_record(
    const std::vector<std::pair<std::string, std::string>>& header, const std::string& data) {
  std::string fields;
  for (const auto& [name, value] : header) fields += with_length(name + "=" + value);
  return with_length(fields) + with_length(data);
}

/// sensor_msgs/LaserScan of ROS 1: `ranges` from -1 rad in steps of 0.5 rad.
[[nodiscard]] inline std::string ros1_laser_scan(std::uint32_t seconds,
                                                 const std::vector<float>& ranges) {
  std::string bytes = bytes_of(std::uint32_t{7}) + bytes_of(seconds) +
                      bytes_of(std::uint32_t{500'000'000}) + with_length("laser");
  for (const float value : {-1.0F, 1.0F, 0.5F, 0.001F, 0.1F, 0.02F, 5.6F}) bytes += bytes_of(value);
  bytes += bytes_of(static_cast<std::uint32_t>(ranges.size()));
  for (const float range : ranges) bytes += bytes_of(range);
  return bytes + bytes_of(std::uint32_t{0});
}

/// nav_msgs/Odometry of ROS 1 at (1, 2), turned by 2 atan(1 / 2), with variances 4, 9 and 0.25.
[[nodiscard]] inline std::string ros1_odometry(std::uint32_t seconds) {
  std::string bytes = bytes_of(std::uint32_t{7}) + bytes_of(seconds) + bytes_of(std::uint32_t{0}) +
                      with_length("odom") + with_length("base");
  for (const double value : {1.0, 2.0, 0.3, 0.0, 0.0, 0.5, 1.0}) bytes += bytes_of(value);
  const auto covariance = [&](double xx, double yy, double yaw) {
    for (int i = 0; i < 36; ++i) {
      bytes += bytes_of(i == 0 ? xx : i == 7 ? yy : i == 35 ? yaw : 0.0);
    }
  };
  covariance(4.0, 9.0, 0.25);
  for (const double value : {0.75, 0.0, 0.0, 0.0, 0.0, 0.125}) bytes += bytes_of(value);
  covariance(1.0, 1.0, 1.0);
  return bytes;
}

[[nodiscard]] inline std::string bag_connection(std::uint32_t id, const std::string& topic,
                                                const std::string& type) {
  return bag_record({{"op", "\x07"}, {"conn", bytes_of(id)}, {"topic", topic}},
                    with_length("topic=" + topic) + with_length("type=" + type));
}

[[nodiscard]] inline std::string bag_message(std::uint32_t connection, std::uint32_t seconds,
                                             const std::string& data) {
  return bag_record({{"op", "\x02"},
                     {"conn", bytes_of(connection)},
                     {"time", bytes_of(seconds) + bytes_of(std::uint32_t{0})}},
                    data);
}

/// A bag of one chunk. `compressed`: the records as `compression` has them.
[[nodiscard]] inline std::string bag(const std::string& records, const std::string& compression,
                                     const std::string& compressed) {
  return std::string(sensor_bridge::rosbag_magic) +
         bag_record({{"op", "\x03"}}, std::string(100, ' ')) +
         bag_record({{"op", "\x05"},
                     {"compression", compression},
                     {"size", bytes_of(static_cast<std::uint32_t>(records.size()))}},
                    compressed);
}

}  // namespace quoin::tests
