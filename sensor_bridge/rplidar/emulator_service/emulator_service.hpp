// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "services/runtime/process/activity.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Makes the emulated device with its endpoint and returns the body that serves clients until the
/// service is stopped. Throws what says why it cannot be.
[[nodiscard]] std::function<void(runtime::Activity&)> open_emulator(
    const ServiceConfig& config, const std::filesystem::path& base_directory);

}  // namespace quoin::sensor_bridge::rplidar
