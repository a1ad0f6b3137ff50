// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/deployment/problems.hpp"
#include "services/deployment/wiring.hpp"
#include "services/deployment/yaml_entries.hpp"

namespace quoin {

/// Of namespaces, services and hosts.
inline constexpr std::size_t longest_name = 64;

/// The presets that a file can ask for.
[[nodiscard]] const std::vector<std::string>& deployment_qos_names();

/// Reads the map of one service; what is wrong is added to `problems`, and nothing returned when it
/// is no map at all. `qos`: the preset for all, if the file has one.
[[nodiscard]] std::optional<DraftService> read_service(const YAML::Node& node,
                                                       const std::optional<std::string>& qos,
                                                       const KindList& kinds, Problems& problems);

}  // namespace quoin
