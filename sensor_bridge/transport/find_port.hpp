// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "sensor_bridge/transport/endpoint.hpp"

namespace quoin::sensor_bridge {

/// What parse_endpoint reads, or for "auto" the serial port of the only adapter of the usual type.
/// Throws EndpointError, with the ports there are when it cannot choose. `root` is where the system
/// is looked at.
[[nodiscard]] Endpoint find_endpoint(std::string_view text,
                                     const std::filesystem::path& root = "/");

}  // namespace quoin::sensor_bridge
