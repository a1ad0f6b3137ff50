// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "services/deployment/deployment.hpp"
#include "services/deployment/problems.hpp"
#include "services/deployment/yaml_entries.hpp"

namespace quoin {

/// Reads the map behind `network:`; what is wrong is added to `problems`.
[[nodiscard]] NetworkConfig read_network(const Entry& entry, Problems& problems);

/// Reads the map behind `security:`; a relative directory starts at `base`, and becomes absolute.
[[nodiscard]] std::optional<SecurityConfig> read_security(const Entry& entry,
                                                          const std::filesystem::path& base,
                                                          Problems& problems);

/// Reads the map behind `ros:`.
[[nodiscard]] std::optional<RosDistro> read_ros(const Entry& entry, Problems& problems);

}  // namespace quoin
