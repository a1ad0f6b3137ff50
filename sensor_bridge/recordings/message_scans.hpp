// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "sensor_bridge/recordings/parameters.hpp"
#include "sensor_bridge/recordings/scan_reader.hpp"

namespace quoin::sensor_bridge {

/// The scans of one topic of a recording of messages (MCAP, ROS 1 bag, ROS 2 bag): LaserScan of ROS
/// 1 and ROS 2, and our own; with the odometry of one topic if that is asked for. Uses `topic`,
/// `start` and `odometry`. Throws ScanFileError, which names the topics of the file where none
/// holds scans, or several do.
[[nodiscard]] std::unique_ptr<ScanReader> open_message_scans(const std::filesystem::path& file,
                                                             const ReplayParameters& parameters);

}  // namespace quoin::sensor_bridge
