// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "services/runtime/process/source.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Returns the body that runs the device and publishes its revolutions, whatever happens to it. A
/// device that is not there is waited for. Throws ParameterError or EndpointError.
[[nodiscard]] std::function<void(runtime::Source&)> open_rplidar(
    const ServiceConfig& config, const std::filesystem::path& base_directory);

}  // namespace quoin::sensor_bridge::rplidar
