// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "sensor_bridge/recordings/scan_geometry.hpp"
#include "sensor_bridge/recordings/scan_reader.hpp"

namespace quoin::sensor_bridge {

/// Scans with raw odometry as one JSON object, plain or compressed, in which the Intel log is
/// passed around:
///
///     {"map": {"976052890.244111": {"range": [1.09, ...], "x": 0.698, "y": -0.015, "theta":
///     -0.46},
///              ...}}
///
/// with ranges [m] in the order of their bearings as `fill_bearings` gives them,
/// and the pose of the robot by its wheels. Throws ScanFileError.
[[nodiscard]] std::unique_ptr<ScanReader> open_scan_json(const std::filesystem::path& file,
                                                         const ScanGeometry& geometry);

}  // namespace quoin::sensor_bridge
