// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "deploy/diagnostics/check.hpp"
#include "deploy/diagnostics/lidar_report.hpp"

namespace quoin::deploy {

/// What the report says, thing by thing, until one makes the others pointless.
[[nodiscard]] Checks lidar_checks(const LidarReport& report);

}  // namespace quoin::deploy
