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
/// A scan is stamped with the wall clock at its publication, as if acquired then: recorded stamps
/// have no known epoch, and ages and latencies downstream must make sense. Duration is 0 and time
/// offsets are empty, for the files do not contain them.
[[nodiscard]] std::function<void(runtime::Source&)> open_replay(
    const ServiceConfig& config, const std::filesystem::path& base_directory);

}  // namespace quoin::sensor_bridge
