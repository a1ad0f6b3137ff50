// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a scan, or as odometry, of ROS 1, of ROS 2 or of ours: the first byte chooses.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sensor_bridge/recordings/laser_scan_message.hpp"
#include "sensor_bridge/recordings/odometry_message.hpp"
#include "tests/fuzz/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace quoin::sensor_bridge;
  if (size == 0) return 0;
  const int choice = data[0] % 6;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (choice >= 3) {
    RecordedOdometry odometry;
    const auto wrong =
        read_odometry_message(static_cast<OdometryMessage>(choice - 3), bytes, odometry);
    const auto& pose = odometry.pose;
    quoin::fuzz::require(std::isfinite(pose.x) && std::isfinite(pose.y) &&
                             std::isfinite(pose.theta) && odometry.covariance.allFinite(),
                         "only what is finite");
    quoin::fuzz::require(wrong.empty() || !odometry.stamp, "nothing of what is wrong");
    return 0;
  }
  static RecordedScan scan;
  const auto kind = static_cast<ScanMessage>(choice);
  const std::string wrong = read_scan_message(kind, bytes, scan);
  quoin::fuzz::require(scan.bearings.size() == scan.ranges.size(), "a bearing for each range");
  quoin::fuzz::require(wrong.empty() || scan.ranges.empty(), "nothing of a scan that is wrong");
  return 0;
}
