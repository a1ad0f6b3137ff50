// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "services/runtime/process/source.hpp"

namespace quoin::sensor_bridge {

/// Opens the scan files and returns the body that publishes their scans at the recorded pace.
/// Throws ParameterError or ScanFileError; the body throws runtime::SourceError where a file turns
/// bad, once all scans before are published.
///
/// A scan is stamped with the wall clock at its publication, as if acquired then, or as recorded
/// (`stamps`), where ages downstream make no sense. Duration is 0 and time offsets are empty where
/// the file does not contain them. Odometry comes before the scan up to which it was recorded.
[[nodiscard]] std::function<void(runtime::Source&)> open_replay(
    const ServiceConfig& config, const std::filesystem::path& base_directory);

}  // namespace quoin::sensor_bridge
