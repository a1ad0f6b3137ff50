// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/methods/parameter.hpp"
#include "deploy/deployment/deployment.hpp"
#include "deploy/deployment/problems.hpp"
#include "deploy/deployment/yaml_entries.hpp"

namespace quoin::deploy {

/// The settings in the map `entry`, with environment variables replaced; what is wrong becomes a
/// problem. Names and values are checked against `known`, unless that is null because the method is
/// not known either.
[[nodiscard]] ParameterSettings read_parameters(const Entry& entry, const ServiceConfig& service,
                                                const std::vector<ParameterInfo>* known,
                                                Problems& problems);

}  // namespace quoin::deploy
