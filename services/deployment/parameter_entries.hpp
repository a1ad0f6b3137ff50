// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/parameters/parameter.hpp"
#include "services/deployment/deployment.hpp"
#include "services/deployment/problems.hpp"
#include "services/deployment/yaml_entries.hpp"

namespace quoin {

/// The settings in the map `entry`, with environment variables replaced; what is wrong becomes a
/// problem. Names and values are checked against `known`, unless that is null because the method is
/// not known either.
[[nodiscard]] ParameterSettings read_parameters(const Entry& entry, const ServiceConfig& service,
                                                const std::vector<ParameterInfo>* known,
                                                Problems& problems);

/// A time [s] from `lowest` to `highest`, with or without unit; nothing, and a problem, when it is
/// none. `what` names it in error texts.
[[nodiscard]] std::optional<double> read_seconds(const Entry& entry, const std::string& what,
                                                 double lowest, double highest, Problems& problems);

}  // namespace quoin
