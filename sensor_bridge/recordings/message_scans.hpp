// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "sensor_bridge/recordings/scan_reader.hpp"

namespace quoin::sensor_bridge {

/// The scans of one topic of a recording of messages (MCAP, ROS 1 bag, ROS 2 bag): LaserScan of ROS
/// 1 and ROS 2, and our own. `topic` "": the only one that has scans. Where there is none, or there
/// are several, the error of the first call to next() names the topics of the file.
[[nodiscard]] std::unique_ptr<ScanReader> open_message_scans(const std::filesystem::path& file,
                                                             const std::string& topic,
                                                             double start);

}  // namespace quoin::sensor_bridge
