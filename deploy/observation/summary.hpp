// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "deploy/observation/figures.hpp"

namespace quoin::deploy {

/// To four digits: these are figures to read and compare, and their own error is larger.
[[nodiscard]] double rounded(double value);

/// The figures as the JSON object that `quoin up --json` ends with. The names in it are an
/// interface: they may be added to, not changed.
[[nodiscard]] nlohmann::ordered_json summary(const DeploymentFigures& figures);

/// The part of it about one service.
[[nodiscard]] nlohmann::ordered_json service_summary(const ServiceFigures& service);

}  // namespace quoin::deploy
