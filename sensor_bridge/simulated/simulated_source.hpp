// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "services/runtime/process/source.hpp"

namespace quoin::sensor_bridge {

/// Opens the world and returns the body that publishes its scans in real time, each at the end of
/// its revolution. Throws ParameterError or WorldError.
[[nodiscard]] std::function<void(runtime::Source&)> open_simulated(
    const ServiceConfig& config, const std::filesystem::path& base_directory);

}  // namespace quoin::sensor_bridge
