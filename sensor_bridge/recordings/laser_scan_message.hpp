// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "sensor_bridge/recordings/recorded_scan.hpp"

namespace quoin::sensor_bridge {

/// Messages that hold a scan.
enum class ScanMessage {
  ros1_laser_scan,  ///< sensor_msgs/LaserScan as ROS 1 serialises it
  ros2_laser_scan,  ///< the same as CDR
  quoin_scan        ///< quoin::msg::Scan as CDR
};

/// What a topic of this type and encoding (cdr, ros1) holds; nothing when it is no scan.
[[nodiscard]] std::optional<ScanMessage> scan_message(std::string_view type,
                                                      std::string_view encoding);

/// Reads the scan into `scan`, whose memory is used again. Returns what is wrong with the bytes,
/// which anybody may have written; "" when nothing is.
[[nodiscard]] std::string read_scan_message(ScanMessage kind, std::string_view bytes,
                                            RecordedScan& scan);

}  // namespace quoin::sensor_bridge
